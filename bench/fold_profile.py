#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How deep the fold from nose to mouth is: fold_profile.py LANDMARKS.json REST.ply NAME=FACE.ply ... [--picture FILE]

All faces have the vertices of REST in the same order, in mm, +z forward. On both sides, at 0.3, 0.5 and 0.7 of the
way from the wing of the nose (points 31, 35) to the corner of the mouth (48, 54), the surface is cut across that
line, from 6 mm on the side of the nose to 26 mm on the side of the cheek. The depth is the greatest distance of the
cut from a straight line between two of its own points, at most 20 mm apart. Beside a face named truth, the others'
mean errors of the six depths (mm) and of the grooves' places along the cuts (mm) are printed. Of each face also how far the
middles of the cheeks go out: the mean displacement along the normal at rest within CHEEK_MM of cheek_L and cheek_R, where
the landmarks have these. Needs Debian's python3-vtk9, python3-scipy and, for pictures, python3-matplotlib."""
import argparse
import json

import numpy as np
import vtk
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import cKDTree
from vtk.util.numpy_support import vtk_to_numpy

STEP_MM = 0.25
ACROSS_MM = np.arange(-6, 26, STEP_MM)
LONGEST = int(20 / STEP_MM)
SHARES = (0.3, 0.5, 0.7)
CHEEK_MM = 15
SIDES = {"right": ("ibug68_31", "ibug68_48", -1), "left": ("ibug68_35", "ibug68_54", 1)}


def surface_of(path):
    reader = vtk.vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def points_of(surface, count=None):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)[:count]
    return 1e3 * points if np.ptp(points[:, 0]) < 1 else points


def outward_normals(surface):
    """Unit normals of the vertices, out of the face (+z in the mean)."""
    made = vtk.vtkPolyDataNormals()
    made.SetInputData(surface)
    made.SplittingOff()
    made.Update()
    normals = vtk_to_numpy(made.GetOutput().GetPointData().GetNormals()).astype(float)
    return normals if normals[:, 2].mean() > 0 else -normals


def profile(points, ala, corner, share, outwards):
    along = points[corner] - points[ala]
    origin = points[ala] + share * along
    across = np.array([-along[1], along[0]]) / np.hypot(along[0], along[1])
    across *= 1 if across[0] * outwards > 0 else -1
    near = np.hypot(*(points - origin)[:, :2].T) < 45
    height = LinearNDInterpolator(points[near, :2], points[near, 2])
    return np.array([float(height(*(origin[:2] + s * across))) for s in ACROSS_MM])


def groove(z):
    """Depth and place across, mm."""
    best = (0.0, 0.0)
    for a in range(len(z)):
        for b in range(a + 8, min(len(z), a + LONGEST)):
            slope = (z[b] - z[a]) / (b - a)
            below = z[a] + slope * np.arange(b - a + 1) - z[a : b + 1]
            at = int(below.argmax())
            best = max(best, (below[at] / np.hypot(1, slope / STEP_MM), ACROSS_MM[a + at]))
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("landmarks")
    parser.add_argument("rest")
    parser.add_argument("faces", nargs="+", metavar="NAME=FACE.ply")
    parser.add_argument("--picture")
    given = parser.parse_args()
    surface = surface_of(given.rest)
    rest = points_of(surface)
    tree = cKDTree(rest)
    with open(given.landmarks) as stream:
        landmarks = json.load(stream)["points"]
    vertex = {name: tree.query(np.array(at, float))[1] for name, at in landmarks.items()}
    faces = {"rest": rest}
    for face in given.faces:
        name, path = face.split("=", 1)
        faces[name] = points_of(surface_of(path), len(rest))
    cuts = {
        name: [
            profile(points, vertex[ala], vertex[corner], share, outwards)
            for ala, corner, outwards in SIDES.values()
            for share in SHARES
        ]
        for name, points in faces.items()
    }
    grooves = {name: np.array([groove(z) for z in lines]) for name, lines in cuts.items()}
    for name, found in grooves.items():
        depths = " ".join(f"{d:.1f}" for d in found[:, 0])
        beside = ""
        if "truth" in grooves:
            error = np.abs(found - grooves["truth"]).mean(axis=0)
            beside = f", off by {error[0]:.2f} mm, in place by {error[1]:.1f} mm"
        print(f"{name:12s} {depths} mean {found[:, 0].mean():.2f} mm{beside}")
    cheeks = [np.array(landmarks[name], float) for name in ("cheek_L", "cheek_R") if name in landmarks]
    if cheeks:
        middle = np.any([np.linalg.norm(rest - cheek, axis=1) < CHEEK_MM for cheek in cheeks], axis=0)
        normals = outward_normals(surface)[middle]
        for name, points in faces.items():
            out = ((points - rest)[middle] * normals).sum(axis=1).mean()
            print(f"{name:12s} middles of the cheeks go out by {out:.2f} mm")
    if given.picture:
        import matplotlib

        matplotlib.use("Agg")
        from matplotlib import pyplot

        _, axes = pyplot.subplots(2, 3, figsize=(13, 6.5))
        for i, axis in enumerate(axes.ravel()):
            for name, lines in cuts.items():
                axis.plot(ACROSS_MM, lines[i] - lines[i][int(6 / STEP_MM)], label=name)
            axis.set_title(f"{list(SIDES)[i // 3]}, {SHARES[i % 3]} of the way")
            axis.set_xlabel("across, towards the cheek (mm)")
            axis.set_ylabel("forward (mm)")
        axes[0, 0].legend(fontsize=7)
        pyplot.tight_layout()
        pyplot.savefig(given.picture, dpi=80)


if __name__ == "__main__":
    main()
