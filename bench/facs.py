#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which muscle makes which shape: facs.py PROGRAM FOLDER_OF_THE_DATA_SET OUT [--check] [SUBJECT ...]

Each expression shape of a rig that the Facial Action Coding System (Ekman, Friesen and Hager 2002) gives to known
muscles, at weight 0.9, is fitted by the program with seven points of the mouth, with the points that drive by default
and with all 68 (subjects A, D and E unless named). One recording holds them all, one after the other, since each of its
samples is fitted by itself. Prints the tables of docs/muscles.md. --check: exit status 1 where fewer are right than
LEAST says, their share is smaller, or a muscle acts more while the jaw opens than JAW_MOST; 77 where the data are
absent."""
import csv
import json
import os
import subprocess
import sys

from rig_cases import HEADS, MOUTH, SUBJECTS, Rig, heads

RINGS = ("oo_up_marg", "oo_lo_marg", "oo_up_per", "oo_lo_per")
UPPER = ("lev_lab_sup", "lev_alaeque", "zyg_minor")
# Action unit, shape, the muscles that make it. The first FIRST are shapes of both sides and of the left side; then those of
# the right side, and last the jaw alone.
ROWS = (
    ("1", "browInnerUp", ("frontal_med",)),
    ("2", "browOuterUp", ("frontal_lat",)),
    ("4", "browDown", ("corrugator", "procerus")),
    ("6", "cheekSquint", ("orb_oculi_lo", "orb_oculi_up", "orb_palpebral", "malaris")),
    ("9", "noseSneer", ("lev_alaeque", "procerus", "nasalis")),
    ("10", "mouthUpperUp", UPPER),
    ("12", "mouthSmile", ("zyg_major",)),
    ("14", "mouthDimple", ("buccinator",)),
    ("15", "mouthFrown", ("dep_anguli",)),
    ("16", "mouthLowerDown", ("dep_lab_inf",)),
    ("17", "mouthShrugLower", ("mentalis",)),
    ("18", "mouthPucker", ("incis_sup", "incis_inf") + RINGS),
    ("20", "mouthStretch", ("risorius", "platysma")),
    ("22", "mouthFunnel", RINGS),
    ("24", "mouthPress", RINGS),
    ("12", "mouthSmile_L", ("zyg_major_L",)),
    ("15", "mouthFrown_L", ("dep_anguli_L",)),
    ("10", "mouthUpperUp_L", tuple(m + "_L" for m in UPPER)),
    ("12", "mouthSmile_R", ("zyg_major_R",)),
    ("15", "mouthFrown_R", ("dep_anguli_R",)),
    ("10", "mouthUpperUp_R", tuple(m + "_R" for m in UPPER)),
    ("26", "jawOpen", ()),
)
FIRST = 18
WEIGHT = 0.9
STEP_S = 0.4  # between a shape and rest
POINTS = ("7", "default", "all")
# What was measured: the right ones among the first shapes and among all, and the mean shares of the right ones in the sum
# of all activations in both, rounded down.
LEAST = {
    "7": {"A": (13, 16, 0.37, 0.38), "D": (13, 16, 0.37, 0.36), "E": (13, 16, 0.39, 0.40)},
    "default": {"A": (16, 19, 0.53, 0.52), "D": (16, 19, 0.52, 0.50), "E": (17, 20, 0.52, 0.51)},
    "all": {"A": (16, 19, 0.56, 0.55), "D": (17, 20, 0.55, 0.53), "E": (16, 19, 0.56, 0.55)},
}
JAW_MOST = 0.2


def write_scene(data, out, subject, points):
    """A recording that visits every shape, and its scene."""
    rig = Rig(f"{data}/ict", subject)
    still = heads(rig)
    names = [f"ibug68_{k}" for k in range(68)]
    fixed = [f"head_{k + 1}" for k in range(HEADS)]
    rows = list(rig.landmarks) + list(still)
    places = [rig.points[rows]]
    for _, shape, _ in ROWS:
        moved = rig.moved({shape: WEIGHT})
        moved[still] = 0
        places += [rig.points[rows] + moved[rows], rig.points[rows]]
    base = f"{out}/{subject}_facs"
    with open(f"{base}_mm.csv", "w") as stream:
        stream.write(",".join(["time_s"] + [f"{n}_{axis}_mm" for n in names + fixed for axis in "xyz"]) + "\n")
        for k, at in enumerate(places):
            stream.write(",".join([f"{k * STEP_S:.1f}"] + [f"{x:.5f}" for x in at.ravel()]) + "\n")
    scan = f"{data}/ict/subject_{subject}"
    driven = {"7": [f"ibug68_{k}" for k in MOUTH], "default": [], "all": names}[points]
    driven = f", points = {json.dumps(driven)}" if driven else ""
    rigid = ", ".join(f'"{n}"' for n in fixed)
    scene = f"{base}_{points}.toml"
    with open(scene, "w") as stream:
        stream.write(
            f'scan = {{ file = "{scan}_neutral_scan.ply", unit = "mm", landmarks = "{scan}_landmarks.json" }}\n'
            f'motion = {{ file = "{subject}_facs_mm.csv", rigid_points = [{rigid}] }}\n'
            f'drive = {{ by = "muscles"{driven} }}\ntime = {{ frame_rate_hz = 1, step_s = 0.05 }}\n'
            "output = { vtu = false, glb = false, report = false }\n"
        )
    return scene


def activations(program, scene):
    """A dictionary from muscle to activation for each shape."""
    out = scene[: -len(".toml")]
    subprocess.run([program, "run", scene, "--out", out], check=True, stdout=subprocess.DEVNULL)
    with open(f"{out}/activations.csv") as stream:
        lines = [row for row in csv.reader(line for line in stream if not line.startswith("#"))]
    by_step = {round(float(row[0]) / STEP_S): row for row in lines[1:]}
    named = [(i, n) for i, n in enumerate(lines[0]) if n[-2:] in ("_L", "_R")]
    return [{n: float(by_step[2 * k + 1][i]) for i, n in named} for k in range(len(ROWS))]


def judged(found, expected):
    """Whether the strongest muscle is expected; the share of the expected in the sum; the strongest and its value."""
    act = {n: max(a, 0.0) for n, a in found.items()}
    right = [n for n in act if n in expected or n[:-2] in expected]
    strongest = max(act, key=act.get)
    return strongest in right, sum(act[n] for n in right) / max(sum(act.values()), 1e-9), strongest, act[strongest]


def summary_of(found):
    """Of the activations in all shapes: how many of the first and of all are right, the mean shares of the right ones in
    both, and the greatest activation while the jaw opens."""
    of_muscles = [judged(acts, expected) for acts, (_, _, expected) in zip(found, ROWS) if expected]
    right = [j[0] for j in of_muscles]
    share = [j[1] for j in of_muscles]
    jaw = max(judged(acts, ())[3] for acts, (_, _, expected) in zip(found, ROWS) if not expected)
    return sum(right[:FIRST]), sum(right), sum(share[:FIRST]) / FIRST, sum(share) / len(share), jaw


def falls_short(subject, points, summary):
    """Whether a summary is worse than what was measured of that subject with these points."""
    least = LEAST[points].get(subject, (0, 0, 0, 0))
    return any(found < wanted for found, wanted in zip(summary, least)) or summary[-1] > JAW_MOST


def print_shapes(results, columns):
    print("| action unit, shape | " + " | ".join(f"{s}, {p}" for s, p in columns) + " |")
    print("|---" * (1 + len(columns)) + "|")
    for k, (unit, shape, expected) in enumerate(ROWS):
        cells = []
        for column in columns:
            is_right, share, name, value = judged(results[column][k], expected)
            mark = "**" if is_right else ""
            cells.append(f"{mark}{name} {value:.2f}{mark}" + (f" ({share:.2f})" if expected else ""))
        print(f"| {unit} {shape} | " + " | ".join(cells) + " |")


def print_summaries(summaries, columns):
    shapes = sum(1 for row in ROWS if row[2])
    lines = (
        (f"right, of the first {FIRST}", "d"),
        (f"right, of all {shapes}", "d"),
        (f"share of the right ones, mean of the first {FIRST}", ".2f"),
        (f"the same of all {shapes}", ".2f"),
        ("greatest while the jaw opens", ".2f"),
    )
    print("\n| | " + " | ".join(f"{s}, {p}" for s, p in columns) + " |")
    print("|---" * (1 + len(columns)) + "|")
    for i, (words, form) in enumerate(lines):
        print(f"| {words} | " + " | ".join(f"{summaries[column][i]:{form}}" for column in columns) + " |")


def main():
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    program, data, out = (os.path.abspath(path) for path in arguments[:3])
    if not os.path.exists(f"{data}/ict/subject_A_rig.glb"):
        sys.exit(77)
    os.makedirs(out, exist_ok=True)
    subjects = arguments[3:] or SUBJECTS
    columns = [(subject, points) for points in POINTS for subject in subjects]
    results = {
        (subject, points): activations(program, write_scene(data, out, subject, points))
        for subject in subjects
        for points in POINTS
    }
    summaries = {column: summary_of(found) for column, found in results.items()}
    print_shapes(results, columns)
    print_summaries(summaries, columns)
    short = [f"{s}, {p}" for s, p in columns if falls_short(s, p, summaries[s, p])]
    if "--check" in sys.argv and short:
        sys.exit(f"worse than measured before ({LEAST}, jaw at most {JAW_MOST}): {'; '.join(short)}")


if __name__ == "__main__":
    main()
