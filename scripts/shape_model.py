#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of how real faces move: shape_model.py RIG.glb LIVE_LINK.csv OUT_FOLDER

RIG.glb: a face with ICT-FaceKit's expression morph targets (MIT). Its shapes, eyes' turns left out, are carried to the
canonical face by the landmarks that both have (a linear radial basis), and written as displacements of its vertices
(expression_shapes.csv). LIVE_LINK.csv: a recording of Live Link Face. From it the spread of each shape's weight and the
couplings between the shapes of one side (expression_couplings.csv); both sides count alike, and none is coupled with
the other. Needs numpy and scipy, and a build (for the canonical face)."""
import csv
import os
import sys

import numpy as np
from scipy.spatial import cKDTree

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "bench"))
from rig_cases import Rig, closest  # noqa: E402

FACE = os.path.join(HERE, "..", "src", "hyperex", "face", "data", "canonical_landmarks.csv")
OBJ = os.path.join(HERE, "..", "build", "release", "src", "hyperex", "face", "canonical_face.obj")
LEFT_OUT = ("Pupil", "eyeLook")
LEAST_MM = 0.05
REST_PERCENTILE = 5  # of a weight: the face at rest
LEAST_SPREAD = 0.1
CHEEK_SPREAD = 0.2  # of a raised cheek at least: trackers see little of a cheek's skin (docs/muscles.md)
COUPLING = 0.8
SMILE_WITH_CHEEK = 0.5  # the mean of two recordings: 0.27 here, 0.71 in action units of another person (docs/muscles.md)
LEAST_EIGENVALUE = 0.03
ROUNDS = 100
UPPER_LIP = (191, 80, 81, 82, 13, 312, 311, 310, 415)
LOWER_LIP = (324, 318, 402, 317, 14, 87, 178, 88, 95)
AS = {"cheekRaiser": "cheekSquint"}  # shapes that the recording has no weight of: as these
MIDDLE = ("eyeSquint", "cheekSquint", "cheekRaiser", "noseSneer")  # go with shapes of the mouth, and with each other
UPPER = ("brow", "eyeBlink", "eyeWide")
RAISED_CHEEK = ("cheekSquint", "cheekRaiser")
LICENCE = """# SPDX-License-Identifier: GPL-3.0-or-later
# Made by scripts/shape_model.py from {source}
"""


def canonical():
    with open(OBJ) as lines:
        points = 10 * np.array([[float(x) for x in line.split()[1:]] for line in lines if line.startswith("v ")])
    landmarks = {}
    with open(FACE) as lines:
        for line in lines:
            name, _, vertices = line.strip().partition(",")
            if line.startswith("ibug68_"):
                landmarks[int(name[7:])] = points[[int(v) for v in vertices.split(",")[0].split()]].mean(0)
    return points, landmarks


def carried(at, to, points):
    """The linear radial basis with an affine part that takes `at` to `to`."""
    affine = np.hstack([np.ones((len(at), 1)), at])
    n = len(at)
    system = np.zeros((n + 4, n + 4))
    system[:n, :n] = np.linalg.norm(at[:, None] - at[None], axis=2)
    system[:n, n:], system[n:, :n] = affine, affine.T
    weights = np.linalg.solve(system, np.vstack([to, np.zeros((4, 3))]))
    kernel = np.linalg.norm(points[:, None] - at[None], axis=2)
    return kernel @ weights[:n] + np.hstack([np.ones((len(points), 1)), points]) @ weights[n:]


def similarity(source, target):
    a, b = source - source.mean(0), target - target.mean(0)
    u, s, vt = np.linalg.svd(a.T @ b)
    flip = np.array([1, 1, np.sign(np.linalg.det(u @ vt))])
    return (s * flip).sum() / (a**2).sum() * (u * flip) @ vt  # row vectors times this


def shapes(rig):
    """Names, and displacements (shapes x 468 x 3) in the canonical face's frame and size, mm."""
    points, landmarks = canonical()
    keys = sorted(landmarks)
    at, to = np.array([landmarks[k] for k in keys]), rig.points[[rig.landmarks[k] for k in keys]]
    distinct = [i for i in range(len(at)) if not any(np.linalg.norm(at[i] - at[j]) < 0.5 for j in range(i))]
    places = carried(at[distinct], to[distinct], points)
    triangles = np.vstack([rig.accessor(p["indices"]).reshape(-1, 3) for p in rig.json["meshes"][0]["primitives"]
                           if rig.material(p) == "face"]).astype(int)
    centres = rig.points[triangles].mean(1)
    opened = rig.moved({"jawOpen": 1})[triangles, 1].mean(1)
    everywhere = np.ones(len(triangles), bool)
    back = similarity(to, at)
    names = [n for n in rig.names if not n.startswith(LEFT_OUT)]
    targets = np.stack([rig.targets[rig.names.index(n)] for n in names])
    out = np.zeros((len(names), len(points), 3))
    middle = opened.min() / 2
    for v, place in enumerate(places):
        among = opened > middle if v in UPPER_LIP else opened < middle if v in LOWER_LIP else everywhere
        candidates = np.flatnonzero(among)
        near = candidates[np.argsort(((centres[candidates] - place) ** 2).sum(1))[:20]]
        best = min(((closest(place, rig.points[triangles[t]]), t) for t in near),
                   key=lambda wt: np.linalg.norm(wt[0] @ rig.points[triangles[wt[1]]] - place))
        out[:, v] = np.einsum("i,kij->kj", best[0], targets[:, triangles[best[1]]])
    return names, out @ back


def recorded(file, names):
    """Weights of the shapes (rows of the recording x shapes) less those at rest; 0 where it has none."""
    with open(file) as lines:
        rows = list(csv.reader(lines))
    columns = {name: i for i, name in enumerate(rows[0])}
    table = np.array([[float(x) for x in row[2:]] for row in rows[1:] if len(row) == len(rows[0])])

    def column(name):
        base, side = (name[:-2], {"_L": "Left", "_R": "Right"}[name[-2:]]) if name[-2:] in ("_L", "_R") else (name, "")
        base = AS.get(base, base)
        for key in (base + side, base):
            if key[0].upper() + key[1:] in columns:
                return table[:, columns[key[0].upper() + key[1:]] - 2]
        return np.zeros(len(table))

    weights = np.stack([column(n) for n in names], 1)
    return weights - np.percentile(weights, REST_PERCENTILE, axis=0)


def mirrored(name):
    if name[-2:] in ("_L", "_R"):
        return name[:-1] + ("R" if name[-1] == "L" else "L")
    return name.replace("Left", "Right") if "Left" in name else name.replace("Right", "Left")


def may_go_together(a, b):
    """What one person did together by chance, as in blinking while the chin was raised, says nothing of others. Kept is
    what anatomy knows: cheeks and nose take part in what the mouth does, and a lowered brow in a wrinkled nose."""
    if a.startswith(UPPER) or b.startswith(UPPER):
        return {a[:8], b[:8]} == {"browDown", "noseSnee"}
    return a.startswith(MIDDLE) or b.startswith(MIDDLE)


def pairs(names, some, others):
    """Of each two names (n x n): whether one begins with one of `some` and the other with one of `others`."""
    a, b = (np.array([n.startswith(group) for n in names]) for group in (some, others))
    return np.outer(a, b) | np.outer(b, a)


def couplings(names, weights):
    """Spreads and correlations of the weights about 0, both sides alike, none across. The correlations are of one
    person who shows a range of motion; of others COUPLING of them is expected, of a smile and a raised cheek
    SMILE_WITH_CHEEK. They are then changed as little as makes them possible (a positive definite matrix)."""
    moment = weights.T @ weights / len(weights)
    other = [names.index(mirrored(n)) for n in names]
    moment = (moment + moment[np.ix_(other, other)]) / 2
    spread = np.sqrt(np.diag(moment))
    correlation = moment / np.maximum(np.outer(spread, spread), 1e-12)
    np.fill_diagonal(correlation, 1)
    side = np.array([{"_L": 1, "_R": -1}.get(n[-2:], 0) for n in names])
    kept = np.array([[may_go_together(a, b) for b in names] for a in names])
    correlation = COUPLING * correlation
    correlation[pairs(names, ("mouthSmile",), RAISED_CHEEK)] = SMILE_WITH_CHEEK
    apart = (np.outer(side, side) < 0) | ~kept
    np.fill_diagonal(apart, False)
    for _ in range(ROUNDS):
        correlation[apart] = 0
        np.fill_diagonal(correlation, 1)
        values, vectors = np.linalg.eigh(correlation)
        correlation = vectors * np.maximum(values, LEAST_EIGENVALUE) @ vectors.T
    correlation[apart] = 0
    return freer_cheeks(names, np.maximum(spread, LEAST_SPREAD), correlation)


def freer_cheeks(names, spread, correlation):
    """With CHEEK_SPREAD. A raised cheek then moves more by itself: its covariances with other shapes stay, but for its
    correlation with a smile."""
    cheek = np.array([n.startswith(RAISED_CHEEK) for n in names])
    wider = np.where(cheek, np.maximum(spread, CHEEK_SPREAD), spread)
    narrower = np.outer(spread / wider, spread / wider)
    narrower[pairs(names, RAISED_CHEEK, RAISED_CHEEK + ("mouthSmile",))] = 1
    return wider, correlation * narrower


def main():
    rig_file, recording, out = sys.argv[1:4]
    names, moved = shapes(Rig.of_file(rig_file))
    spread, correlation = couplings(names, recorded(recording, names))
    with open(os.path.join(out, "expression_shapes.csv"), "w") as file:
        file.write(LICENCE.format(source="ICT-FaceKit (USC Institute for Creative Technologies, MIT licence)"))
        file.write("# Displacement of a vertex of the canonical face where a shape's weight is 1.\n")
        file.write("shape,vertex,x_mm,y_mm,z_mm\n")
        for k, name in enumerate(names):
            for v in np.flatnonzero(np.linalg.norm(moved[k], axis=1) > LEAST_MM):
                file.write(f"{name},{v}," + ",".join(f"{x:.2f}" for x in moved[k, v]) + "\n")
    with open(os.path.join(out, "expression_couplings.csv"), "w") as file:
        file.write(LICENCE.format(source="a range of motion recorded by Live Link Face (MIT licence)"))
        file.write("# Of two shapes the correlation of their weights; of a shape with itself the weight's spread.\n")
        file.write("shape,other,value\n")
        for i, name in enumerate(names):
            file.write(f"{name},{name},{spread[i]:.3f}\n")
            for j in range(i):
                if abs(correlation[i, j]) > 0.02:
                    file.write(f"{name},{names[j]},{correlation[i, j]:.3f}\n")


if __name__ == "__main__":
    main()
