#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a rig's shapes lie from the true ones: rig_error.py FOLDER_OF_THE_DATA_SET SUBJECT=RIG.glb ... [--shapes]

SUBJECT is A, D or E of the data set, and RIG.glb what `hyperex rig` made of subject_X_neutral_scan.ply. The truth are the
shapes of the public rig, from which the scans come. For each rig the mean over shapes of the mean distance over the skin
within 95 mm of the nose's tip (mm), that of a face that stands still, and in how many shapes the rig is nearer. With
--shapes also each shape's two distances. Left out are shapes that move no skin of a scan: a gaze aside and the tongue.
The rig's shapes are made from the same public rig, so that this is no fair test. Needs Debian's python3-scipy."""
import argparse
import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig_cases  # noqa: E402

AROUND_MM = 95
STILL = ("eyeLookIn", "eyeLookOut", "tongueOut")
ONE_SHAPE = ("jawLeft", "jawRight", "mouthLeft", "mouthRight")  # of both sides, in the public rig too


class Made(rig_cases.Rig):
    """A rig of `hyperex rig`."""

    def __init__(self, file):
        self.read(file)

    def read(self, file):
        self.open(file)
        face = next(node for node in self.json["nodes"] if node.get("name") == "face")
        mesh = self.json["meshes"][face["mesh"]]
        skin = mesh["primitives"][0]
        self.names = mesh["extras"]["targetNames"]
        self.nose = 1e3 * np.array(mesh["extras"]["landmarks_m"]["pronasale"])
        self.points = 1e3 * self.accessor(skin["attributes"]["POSITION"]).astype(float)
        self.targets = [1e3 * self.accessor(target["POSITION"]).astype(float) for target in skin["targets"]]


def true_name(name):
    for ending, mark in (("Left", "_L"), ("Right", "_R")):
        if name.endswith(ending) and name not in ONE_SHAPE:
            return name[: -len(ending)] + mark
    return name


def distances(data, subject, made):
    """For each shape that moves skin: its name, the mean distance from the truth, and that of standing still, mm."""
    truth = rig_cases.Rig(f"{data}/ict", subject)
    scan, _, _ = rig_cases.read_ply(f"{data}/ict/subject_{subject}_neutral_scan.ply")
    opened, _, _ = rig_cases.read_ply(f"{data}/ict/subject_{subject}_mouth_open_truth.ply")
    if len(made.points) < len(scan) or np.abs(made.points[: len(scan)] - scan).max() > 0.01:
        sys.exit(f"{subject}: expected a rig of subject_{subject}_neutral_scan.ply with all its vertices")
    triangle, weight = rig_cases.places(truth, scan, opened)
    near = np.linalg.norm(scan - made.nose, axis=1) < AROUND_MM
    for name, target in zip(made.names, made.targets):
        if name.startswith(STILL) or "_" in name:
            continue
        moved = truth.moved({true_name(name): 1})
        true = (weight[:, :, None] * moved[truth.triangles[triangle]]).sum(1)[near]
        off = np.linalg.norm(target[: len(scan)][near] - true, axis=1).mean()
        yield name, off, np.linalg.norm(true, axis=1).mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data")
    parser.add_argument("rigs", nargs="+", metavar="SUBJECT=RIG.glb")
    parser.add_argument("--shapes", action="store_true")
    options = parser.parse_args()
    for given in options.rigs:
        subject, _, file = given.partition("=")
        rows = list(distances(options.data, subject, Made(file)))
        if options.shapes:
            for name, off, still in rows:
                print(f"{subject} {name:20} {off:5.2f} {still:5.2f}")
        off, still = np.array([row[1:] for row in rows]).T
        print(f"{subject}: {len(rows)} shapes, {off.mean():.2f} mm, standing still {still.mean():.2f} mm, "
              f"nearer than that in {(off < still).sum()}")


if __name__ == "__main__":
    main()
