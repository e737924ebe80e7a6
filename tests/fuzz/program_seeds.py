# SPDX-License-Identifier: GPL-3.0-or-later
"""Small sound inputs of every format that the program reads, for mutate_program.py.

Each format: the file that is changed, sound contents of it, what must lie beside it, and the calls that
read it. Calls are lists of arguments; SCENE stands for a coarse scene of three frames.
"""
import base64
import io
import json
import os
import struct
import subprocess
import zipfile
import zlib

COARSE = [a for pair in ["mesh.element_size_mm=12", "mesh.layers=1", "time.end_s=0.05", "time.step_s=0.025",
                         "time.frame_rate_hz=40", "output.picture_times_s=[0]"] for a in ("--set", pair)]
SCENE = b'scan = { file = "embedded" }\nmotion = { file = "embedded" }\n'
CORNERS = [(0, 0, 0), (150, 0, 0), (150, 160, 20), (0, 160, 0)]


class Format:
    def __init__(self, name, file, seeds, calls, beside=None):
        self.name, self.file, self.seeds, self.calls, self.beside = name, file, seeds, calls, beside or {}


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def png(width=4, height=4, deep=False):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    row = b"\0" + bytes(k % 256 for k in range(width * (2 if deep else 3)))
    head = struct.pack(">IIBBBBB", width, height, 16 if deep else 8, 0 if deep else 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(row * height)) +
            chunk(b"IEND", b""))


def face_of(glb_bytes):
    """Points (mm) and triangles of the tracked face, as `hyperex track --glb` writes it."""
    size, = struct.unpack_from("<I", glb_bytes, 12)
    tree, data = json.loads(glb_bytes[20:20 + size]), glb_bytes[28 + size:]

    def numbers(accessor, kind, each):
        view = tree["bufferViews"][tree["accessors"][accessor]["bufferView"]]
        return list(struct.iter_unpack(f"<{each}{kind}", data[view.get("byteOffset", 0):][:view["byteLength"]]))
    primitive = tree["meshes"][0]["primitives"][0]
    return ([tuple(1000 * x for x in p) for p in numbers(primitive["attributes"]["POSITION"], "f", 3)],
            numbers(primitive["indices"], "I", 3))


def landmarks_of(csv):
    """The first sample of a motion in mm."""
    names, values = (line.split(",") for line in csv.decode().split("\n")[:2])
    return {"units": "mm", "points": {names[k][:-5]: [float(x) for x in values[k:k + 3]]
                                      for k in range(1, len(names) - 2, 3)}}


def ply_text(points, triangles, more=""):
    return (f"ply\nformat ascii 1.0\ncomment unit mm\nelement vertex {len(points)}\nproperty float x\n"
            f"property float y\nproperty float z\n{more}element face {len(triangles)}\n"
            "property list uchar int vertex_indices\nend_header\n")


def ply_ascii(points, triangles, colour=""):
    names = "".join(f"property uchar {c}\n" for c in ("red", "green", "blue")) if colour else ""
    return (ply_text(points, triangles, names) + "".join(f"{x:.2f} {y:.2f} {z:.2f}{colour}\n" for x, y, z in points) +
            "".join(f"{len(t)} {' '.join(map(str, t))}\n" for t in triangles)).encode()


def ply_binary(points, triangles, order="<"):
    kind = "little" if order == "<" else "big"
    head = ply_text(points, triangles).replace("ascii", f"binary_{kind}_endian").encode()
    return (head + b"".join(struct.pack(order + "3f", *p) for p in points) +
            b"".join(struct.pack(f"{order}B{len(t)}i", len(t), *t) for t in triangles))


def obj(points, triangles, first="mtllib in.mtl\nusemtl skin\n"):
    return (first + "".join(f"v {x:.2f} {y:.2f} {z:.2f}\nvt {x / 200 + .5:.3f} {y / 300 + .5:.3f}\n"
                            for x, y, z in points) +
            "".join("f " + " ".join(f"{c + 1}/{c + 1}" for c in t) + "\n" for t in triangles)).encode()


def stl(points, triangles, text):
    if text:
        return ("solid face\n" + "".join(
            "facet normal 0 0 1\nouter loop\n" + "".join("vertex {:.2f} {:.2f} {:.2f}\n".format(*points[c]) for c in t) +
            "endloop\nendfacet\n" for t in triangles) + "endsolid face\n").encode()
    return (b" " * 80 + struct.pack("<I", len(triangles)) + b"".join(
        struct.pack("<12fH", 0, 0, 1, *(x for c in t for x in points[c]), 0) for t in triangles))


def gltf_parts(points, triangles, targets=(), landmarks=None):
    """The JSON (without its buffer) and the bytes, metres; targets: names of morph targets, made up."""
    flat = b"".join(struct.pack("<3f", *(x / 1000 for x in p)) for p in points)
    places = b"".join(struct.pack("<2f", x / 200 + .5, .5 - y / 300) for x, y, _ in points)
    corners = b"".join(struct.pack("<I", c) for t in triangles for c in t)
    blocks = [flat, places, corners]
    for k, _ in enumerate(targets):
        blocks.append(b"".join(struct.pack("<3f", 0, -.01 * (y < -30) * (k % 3), .002 * (x > 0) * (k % 2))
                               for x, y, _ in points))
    at, views = 0, []
    for block in blocks:
        views.append({"buffer": 0, "byteOffset": at, "byteLength": len(block)})
        at += len(block)
    accessors = [{"bufferView": k, "componentType": 5126, "count": len(points),
                  "type": "VEC2" if k == 1 else "VEC3"} for k in range(len(blocks))]
    accessors[2] = {"bufferView": 2, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"}
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}
    mesh = {"primitives": [primitive]}
    if targets:
        primitive["targets"] = [{"POSITION": 3 + k} for k in range(len(targets))]
        mesh["extras"] = {"targetNames": list(targets), "landmarks_m": landmarks}
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"children": [1], "translation": [0, .001, 0], "rotation": [0, 0, 0, 1]}, {"mesh": 0}],
            "meshes": [mesh], "accessors": accessors, "bufferViews": views,
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"uri": "skin.png"}]}, b"".join(blocks)


def gltf(parts, uri=""):
    tree, data = parts
    uri = uri or "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps({**tree, "buffers": [{"byteLength": len(data), "uri": uri}]}).encode()


def glb(parts):
    tree, data = parts
    text = json.dumps({**tree, "buffers": [{"byteLength": len(data)}]}).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    return (b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(data)) + struct.pack("<I", len(text)) + b"JSON" +
            text + struct.pack("<I", len(data)) + b"BIN\0" + data)


def avi(pictures, width, height):
    """JPEG pictures as a video, 30 a second."""
    def chunk(name, data):
        return name + struct.pack("<I", len(data)) + data + b"\0" * (len(data) % 2)

    def group(name, data):
        return chunk(b"LIST", name + data)
    count = len(pictures)
    head = struct.pack("<14I", 33333, 1 << 20, 0, 16, count, 0, 1, 1 << 20, width, height, 0, 0, 0, 0)
    stream = b"vidsMJPG" + struct.pack("<10I4H", 0, 0, 0, 1, 30, 0, count, 1 << 20, 0xffffffff, 0, 0, 0, width, height)
    form = struct.pack("<IiiHH4s5I", 40, width, height, 1, 24, b"MJPG", 3 * width * height, 0, 0, 0, 0)
    frames = b"".join(chunk(b"00dc", p) for p in pictures)
    return chunk(b"RIFF", b"AVI " + group(b"hdrl", chunk(b"avih", head) + group(
        b"strl", chunk(b"strh", stream) + chunk(b"strf", form))) + group(b"movi", frames))


def zipped(files, way):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", way) as file:
        for name in sorted(files):
            file.writestr(zipfile.ZipInfo("rec/" + name), files[name], compress_type=way)
    return out.getvalue()


def trc(csv):
    rows = [line.split(",") for line in csv.decode().splitlines()]
    names = [n[:-5] for n in rows[0][1::3]]
    head = ("PathFileType\t4\t(X/Y/Z)\tin.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t"
            f"OrigDataStartFrame\tOrigNumFrames\n30\t30\t{len(rows) - 1}\t{len(names)}\tmm\t30\t1\t{len(rows) - 1}\n"
            "Frame#\tTime\t" + "\t\t\t".join(names) + "\n\t\t" +
            "\t".join(f"X{k}\tY{k}\tZ{k}" for k in range(1, len(names) + 1)) + "\n\n")
    return (head + "".join(f"{k}\t" + "\t".join(row) + "\n" for k, row in enumerate(rows[1:], 1))).encode()


def recording_of(folder, frames=3):
    """The first frames of a recording: path and bytes."""
    lines = read(folder, "associations.txt").split(b"\n")[:frames]
    names = [name.decode() for line in lines for name in line.split()[1::2]]
    return {"camera.toml": read(folder, "camera.toml"), "associations.txt": b"\n".join(lines) + b"\n",
            **{name: read(folder, name) for name in names}}


def made_by(program, folder, environment):
    """What the program itself makes: data to try it with, and a run of three frames. Once a folder."""
    def call(*arguments):
        done = subprocess.run([program, *arguments], cwd=folder, env=environment, capture_output=True)
        if done.returncode != 0:
            raise SystemExit(f"mutate_program: {arguments[0]} of sound inputs ended with {done.returncode}:\n" +
                             done.stderr.decode("utf-8", "replace"))
    if not os.path.exists(os.path.join(folder, "made")):
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "scene.toml"), "wb") as file:
            file.write(SCENE)
        call("sample", "sample")
        few = os.path.join(folder, "recording")
        for name, data in recording_of(os.path.join(folder, "sample", "recording")).items():
            os.makedirs(os.path.dirname(os.path.join(few, name)), exist_ok=True)
            with open(os.path.join(few, name), "wb") as file:
                file.write(data)
        call("track", "recording", "--out", "tracked.csv", "--glb", "tracked.glb")
        call("run", "scene.toml", "--out", "run", *COARSE, "--set", "output.vtu=false", "--set", "drive.by=displacement",
             "--set", "output.glb=false", "--set", "output.report=false", "--set", "time.end_s=0.15")
        open(os.path.join(folder, "made"), "w").close()
    return folder


def scan_calls(name):
    """Readers of scans: each alone, then all that stands behind them."""
    own = ["--set", f"scan.file={name}", "--set", "scan.landmarks=l.json"]
    return ([["compare", name, name, "--json"]] * 3 + [["new", name, "embedded", "--out", "new.toml"]] * 3 +
            [["check", "s.toml", *own]] * 4 +
            [["mesh", name, "--landmarks", "l.json", "--out", "m.vtu", "--element-size-mm", "12", "--layers", "1"]] * 4 +
            [["run", "s.toml", "--out", "out", *own, *COARSE]] * 3 +
            [["compare", name, "sound.ply", "--landmarks", "l.json", "--picture", "d.png"]])
