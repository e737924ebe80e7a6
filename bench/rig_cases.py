#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes with known answers from a rig: rig_cases.py FOLDER_OF_THE_DATA_SET OUT [SUBJECT ...] [EXPRESSION ...]

Of each expression below and each subject (A, D and E unless named): the scan moved as the rig moves
(SUBJECT_NAME_truth.ply, same vertices), a ramp of one second of its 68 landmarks (SUBJECT_NAME_mm.csv), scenes with
seven and with all points (SUBJECT_NAME_7.toml, SUBJECT_NAME_all.toml), and for muscle_bench OUT/cases.txt, with the
real smile and the markers, which belong to no subject of the rig. Where expressions are named, those alone, FURTHER
ones too. About a minute a subject. Needs Debian's python3-scipy."""
import csv
import json
import os
import struct
import sys

import numpy as np

EXPRESSIONS = {
    "oneSmile": {"mouthSmile_L": 0.9},
    "oneSmileR": {"mouthSmile_R": 0.9},
    "smileCheeks": {"mouthSmile": 0.8, "cheekSquint": 0.6, "cheekRaiser": 0.6},
    "pucker": {"mouthPucker": 0.8},
    "frown": {"mouthFrown": 0.8, "browDown": 0.8},
    "upperUp": {"mouthUpperUp": 0.7, "jawOpen": 0.2},
    "jawSmile": {"jawOpen": 0.4, "mouthSmile": 0.7},
    "jawOpen": {"jawOpen": 0.75},
    "jawLeft": {"jawLeft": 0.8, "jawOpen": 0.3},
    "sneer": {"noseSneer": 0.8, "mouthUpperUp": 0.3},
    "surprise": {"browInnerUp": 0.9, "browOuterUp": 0.9, "eyeWide": 0.7, "jawOpen": 0.35},
    "funnel": {"mouthFunnel": 0.8},
    "puff": {"cheekPuff": 0.7},
    "stretch": {"mouthStretch": 0.8},
    "lowerDown": {"mouthLowerDown": 0.8},
    "dimple": {"mouthDimple": 0.8},
    "mouthLeft": {"mouthLeft": 0.8},
    "press": {"mouthPress": 0.8},
    "shrug": {"mouthShrugLower": 0.8, "mouthShrugUpper": 0.4},
    "snarlL": {"noseSneer_L": 0.9, "mouthUpperUp_L": 0.7},
}
FURTHER = {  # made where they are named
    "mouthRight": {"mouthRight": 0.8},
    "winkL": {"eyeBlink_L": 1, "cheekSquint_L": 0.6},
    "winkR": {"eyeBlink_R": 1, "cheekSquint_R": 0.6},
}
TALK_S = {"talk46": 1.533333, "talk24": 0.8, "talk69": 2.3, "talk93": 3.1}  # of the talk recording
MOUTH = (48, 54, 51, 57, 8, 58, 56)
HEADS = 6  # points of the skull, which stand still
TYPES = {5126: np.float32, 5125: np.uint32, 5123: np.uint16}


SUBJECTS = ("A", "D", "E")


class Rig:
    """Positions and morph targets in mm. The targets were made for subject A; they are added to all subjects' points."""

    @classmethod
    def of_file(cls, file):
        rig = cls.__new__(cls)
        rig.read(file)
        return rig

    def __init__(self, folder, subject):
        self.read(f"{folder}/subject_A_rig.glb")
        if subject != "A":
            self.points, _, _ = read_ply(f"{folder}/subject_{subject}_rig_neutral.ply")
            self.points *= 1e3

    def open(self, file):
        with open(file, "rb") as stream:
            data = stream.read()
        length = struct.unpack("<I", data[12:16])[0]
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[20 + length + 8 :]

    def read(self, file):
        self.open(file)
        mesh = self.json["meshes"][0]
        self.names = mesh["extras"]["targetNames"]
        self.landmarks = mesh["extras"]["landmarks68"]
        first = mesh["primitives"][0]
        self.points = 1e3 * self.accessor(first["attributes"]["POSITION"]).astype(float)
        self.targets = [1e3 * self.accessor(t["POSITION"]).astype(float) for t in first["targets"]]
        skin = [p for p in mesh["primitives"] if self.material(p) in ("face", "head_neck", "mouth_socket")]
        self.triangles = np.vstack([self.accessor(p["indices"]).reshape(-1, 3) for p in skin]).astype(int)

    def material(self, primitive):
        return self.json["materials"][primitive["material"]]["name"]

    def view(self, part, kind, count):
        view = self.json["bufferViews"][part["bufferView"]]
        offset = view.get("byteOffset", 0) + part.get("byteOffset", 0)
        return np.frombuffer(self.binary, kind, count, offset)

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        kind = TYPES[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        sparse = accessor.get("sparse")
        if not sparse:
            return self.view(accessor, kind, accessor["count"] * width).reshape(-1, width)
        out = np.zeros((accessor["count"], width), kind)
        rows = self.view(sparse["indices"], TYPES[sparse["indices"]["componentType"]], sparse["count"])
        out[rows] = self.view(sparse["values"], kind, sparse["count"] * width).reshape(-1, width)
        return out

    def moved(self, weights):
        out = np.zeros_like(self.points)
        for name, weight in weights.items():
            # "noseSneer_" is the right one's name in this file.
            sides = [name] if name in self.names else [n for n in self.names if n[:-1] == name + "_" or n == name + "_"]
            for side in sides:
                out += weight * self.targets[self.names.index(side)]
        return out


def read_ply(file):
    """Positions, the header, and what follows the vertices, of a PLY with x, y, z as floats."""
    with open(file, "rb") as stream:
        data = stream.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    count = int(next(line for line in data[:end].split(b"\n") if line.startswith(b"element vertex")).split()[2])
    points = np.frombuffer(data, "<f4", 3 * count, end).reshape(-1, 3)
    return points.astype(float), data[:end], data[end + points.nbytes :]


def closest(p, corners):
    """Barycentric weights of the point of a triangle nearest to p."""
    a, b, c = corners
    edges = np.stack([b - a, c - a], 1)
    weights = np.linalg.lstsq(edges, p - a, rcond=None)[0]
    weights = np.array([1 - weights.sum(), *weights])
    if weights.min() >= 0:
        return weights
    best = None
    for i, j in ((0, 1), (1, 2), (0, 2)):
        edge = corners[j] - corners[i]
        t = np.clip((p - corners[i]) @ edge / max(edge @ edge, 1e-12), 0, 1)
        distance = np.linalg.norm(corners[i] + t * edge - p)
        if best is None or distance < best[0]:
            on_edge = np.zeros(3)
            on_edge[[i, j]] = 1 - t, t
            best = distance, on_edge
    return best[1]


def places(rig, scan, opened):
    """Triangle and weights of each vertex of the scan; where the lips touch, the known opening tells them apart."""
    vertices = np.unique(rig.triangles)
    around = [[] for _ in rig.points]
    for t, triangle in enumerate(rig.triangles):
        for corner in triangle:
            around[corner].append(t)
    jaw = rig.moved({"jawOpen": 0.75})
    from scipy.spatial import cKDTree  # the rig itself needs none

    _, near = cKDTree(rig.points[vertices]).query(scan, 8)
    found, weights, farthest = np.zeros(len(scan), int), np.zeros((len(scan), 3)), 0
    for v in range(len(scan)):
        best = (np.inf,)
        for t in set(sum((around[vertices[k]] for k in near[v]), [])):
            corners = rig.triangles[t]
            w = closest(scan[v], rig.points[corners])
            off = np.linalg.norm(w @ rig.points[corners] - scan[v])
            off += np.linalg.norm(scan[v] + w @ jaw[corners] - opened[v])
            if off < best[0]:
                best = off, t, w
        farthest = max(farthest, best[0])
        found[v], weights[v] = best[1:]
    print(f"scan to rig, at rest and opened together: at most {farthest:.2f} mm")
    return found, weights


def heads(rig):
    """Points of forehead and bridge."""
    vertices = np.unique(rig.triangles)
    bridge = rig.points[rig.landmarks[27]]
    front = vertices[rig.points[vertices][:, 2] > bridge[2] - 80]
    offsets = ((-45, 30), (45, 30), (0, 45), (-60, -10), (60, -10), (0, 30))
    return [front[np.argmin(np.linalg.norm(rig.points[front][:, :2] - bridge[:2] - o, axis=1))] for o in offsets]


def write_motion(file, rig, moved, still):
    names = [f"ibug68_{k}" for k in range(68)] + [f"head_{k + 1}" for k in range(HEADS)]
    with open(file, "w") as out:
        out.write(",".join(["time_s"] + [f"{n}_{axis}_mm" for n in names for axis in "xyz"]) + "\n")
        for i in range(31):
            t = i / 30
            at = np.vstack([rig.points[rig.landmarks] + t * moved[rig.landmarks], rig.points[still]])
            out.write(",".join([f"{t:.6f}"] + [f"{x:.5f}" for x in at.ravel()]) + "\n")


def write_scene(file, name, scan_of, points):
    scan = f'"{scan_of}_neutral_scan.ply", unit = "mm", landmarks = "{scan_of}_landmarks.json"'
    rigid = ", ".join(f'"head_{k + 1}"' for k in range(HEADS))
    drive = f"drive = {{ points = [{points}] }}\n"
    with open(file, "w") as out:
        out.write(
            f'title = "{name}"\nscan = {{ file = {scan} }}\n'
            f'motion = {{ file = "{name}_mm.csv", rigid_points = [{rigid}] }}\n{drive}time = {{ end_s = 1.2 }}\n'
            "output = { peak_time_s = 1.2, vtu = false, glb = false, report = false }\n"
        )


def expressions(rig, data):
    all_of_them = dict(EXPRESSIONS)
    with open(f"{data}/rgbd/subject_A_talk/truth_weights.csv") as stream:
        rows = list(csv.reader(stream))
    for name, time_s in TALK_S.items():
        row = min(rows[1:], key=lambda r: abs(float(r[0]) - time_s))
        all_of_them[name] = {k: float(v) for k, v in zip(rows[0][1:], row[1:]) if k in rig.names and float(v)}
    return all_of_them


def write_subject(data, out, subject, named=()):
    """All expressions of one subject, or those named; returns their lines for muscle_bench."""
    scan_of = f"{data}/ict/subject_{subject}"
    rig = Rig(f"{data}/ict", subject)
    scan, header, tail = read_ply(f"{scan_of}_neutral_scan.ply")
    opened, _, _ = read_ply(f"{scan_of}_mouth_open_truth.ply")
    triangle, weight = places(rig, scan, opened)
    still = heads(rig)
    lines = []
    known = expressions(rig, data)
    if named:
        known = {expression: (known | FURTHER)[expression] for expression in named}
    for expression, weights in known.items():
        name = f"{subject}_{expression}"
        moved = rig.moved(weights)
        carried = (weight[:, :, None] * moved[rig.triangles[triangle]]).sum(1)
        with open(f"{out}/{name}_truth.ply", "wb") as stream:
            stream.write(header + (scan + carried).astype("<f4").tobytes() + tail)
        write_motion(f"{out}/{name}_mm.csv", rig, moved, still)
        mouth = ", ".join(f'"ibug68_{k}"' for k in MOUTH)
        every = ", ".join(f'"ibug68_{k}"' for k in range(68))
        for kind, points in (("7", mouth), ("all", every)):
            write_scene(f"{out}/{name}_{kind}.toml", name, scan_of, points)
            lines.append(f"{name} {out}/{name}_{kind}.toml {out}/{name}_truth.ply {kind}")
    return lines


def main():
    data, out = (os.path.abspath(path) for path in sys.argv[1:3])
    subjects = [name for name in sys.argv[3:] if name in SUBJECTS]
    named = [name for name in sys.argv[3:] if name not in SUBJECTS]
    known = [*EXPRESSIONS, *FURTHER, *TALK_S]
    for name in named:
        if name not in known:
            sys.exit(f"{name} is no subject and no expression: expected one of {', '.join([*SUBJECTS, *known])}")
    os.makedirs(out, exist_ok=True)
    lines = []
    if not named:
        smile = f"{data}/real/spacetime/smile"
        lines += [f"real {smile}_{kind}.toml {smile}.ply {kind}" for kind in ("7", "all")]
        lines.append(f"markers {data}/real/animface/cheeks_7.toml - markers")
    for subject in subjects or SUBJECTS:
        lines += write_subject(data, out, subject, named)
    with open(f"{out}/cases.txt", "w") as stream:
        stream.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
