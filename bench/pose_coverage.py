#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the floors of the head's pose hold? pose_coverage.py FOLDER_OF_THE_DATA_SET HYPEREX [NOISE_MM ...]

Each expression below and of rig_cases.py, on the subjects A, D and E: 68 points at 30 Hz, which go there within a
second and stay, with white noise (0.05 and 0.3 mm unless given), while the head turns by 6 degrees. `hyperex symmetry`
measures the excursions of each pair of points. Written is how far they are from those of the rig, in how many the error
of a difference is within the floors of jitter and pose, and by how much it exceeds them at most (mm). The prior of the pose was learned from the shapes of the
same rig, so a face that moves in other ways is covered less often. Five minutes."""
import csv
import re
import subprocess
import sys
import tempfile

import numpy as np
import rig_cases

MORE = {
    "browDown": {"browDown": 0.9},
    "browUp": {"browInnerUp": 0.9, "browOuterUp": 0.9},
    "wink": {"eyeBlink_L": 1.0, "cheekSquint_L": 0.8},
    "disgust": {"noseSneer": 0.9, "mouthUpperUp": 0.7, "browDown": 0.7, "cheekSquint": 0.5},
    "smile": {"mouthSmile": 0.9},
}
ONE_SIDED = ("oneSmile", "oneSmileR", "snarlL", "wink", "mouthLeft", "jawLeft")
SAMPLES, TURN_RAD = 60, np.radians(6)
CORNERS = (48, 54)


def turned(points, angle):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T


def write_recording(file, rest, moved, noise_mm, random):
    names = [f"ibug68_{k}_{axis}_mm" for k in range(68) for axis in "xyz"]
    with open(file, "w") as out:
        out.write(",".join(["time_s"] + names) + "\n")
        for i in range(SAMPLES):
            t = min(1, i / 30)
            here = turned(rest + t * t * (3 - 2 * t) * moved, TURN_RAD * min(1, i / 40))
            here = here + random.normal(0, noise_mm, here.shape)
            out.write(",".join([f"{i / 30:.6f}"] + [f"{x:.5f}" for x in here.ravel()]) + "\n")


def measured(hyperex, folder, rest, moved, noise_mm, random):
    """For each pair of points: errors of both excursions and of their difference (mm), 1 sigma of the difference."""
    recording, table = f"{folder}/recording.csv", f"{folder}/excursions.csv"
    write_recording(recording, rest, moved, noise_mm, random)
    subprocess.run(
        [hyperex, "symmetry", recording, "--unit", "mm", "--excursions", table], check=True, capture_output=True
    )
    true = np.linalg.norm(moved, axis=1)
    with open(table) as stream:
        for row in csv.DictReader(stream):
            pair = re.fullmatch(r"ibug68_(\d+)/(\d+)", row["point"])
            if not pair:
                continue
            right, left = int(pair[1]), int(pair[2])
            off_right = float(row["excursion_R_mm"]) - true[right]
            off_left = float(row["excursion_L_mm"]) - true[left]
            floor = np.hypot(float(row["pose_floor_mm"] or 0), float(row["jitter_floor_mm"] or 0))
            yield (right, left) == CORNERS, off_right, off_left, off_left - off_right, floor / 1.96


def line(name, rows):
    errors = np.array([row[3] for row in rows])
    sigma = np.array([row[4] for row in rows])
    sides = np.array([row[1:3] for row in rows])
    rms = lambda values: np.sqrt(np.mean(np.square(values)))
    inside = np.mean(np.abs(errors) < 1.96 * sigma)
    print(
        f"| {name} | {rms(sides):.2f} | {rms(errors):.2f} | {rms(sigma):.2f} | {rms(errors / sigma):.2f} "
        f"| {100 * inside:.0f} % of {len(rows)} | {np.max(np.abs(errors) - 1.96 * sigma):.2f} |",
        flush=True,
    )


def main():
    data, hyperex = sys.argv[1:3]
    print(
        "| | rms error of an excursion | of a difference | sigma | rms of error / sigma | inside "
        "| beyond |\n|" + "---|" * 7
    )
    for noise_mm in [float(x) for x in sys.argv[3:]] or [0.05, 0.3]:
        random = np.random.default_rng(5)
        found = []
        with tempfile.TemporaryDirectory() as folder:
            for subject in rig_cases.SUBJECTS:
                rig = rig_cases.Rig(f"{data}/ict", subject)
                rest = rig.points[rig.landmarks]
                for name, weights in (rig_cases.expressions(rig, data) | MORE).items():
                    moved = rig.moved(weights)[rig.landmarks]
                    found += [(name, *row) for row in measured(hyperex, folder, rest, moved, noise_mm, random)]
        line(f"{noise_mm:g} mm of noise: all pairs", [row[1:] for row in found])
        line("corners of the mouth", [row[1:] for row in found if row[1]])
        line("all pairs, one-sided expressions", [row[1:] for row in found if row[0] in ONE_SIDED])
        line("corners, one-sided expressions", [row[1:] for row in found if row[0] in ONE_SIDED and row[1]])


if __name__ == "__main__":
    main()
