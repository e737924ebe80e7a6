# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of formats of mutate_program.py: what is changed, what lies beside it, who reads it."""
import gzip
import json
import os
import zipfile

import program_ct as ct
from program_seeds import (COARSE, CORNERS, SCENE, Format, avi, face_of, glb, gltf, gltf_parts, landmarks_of, obj,
                           ply_ascii, ply_binary, png, read, recording_of, scan_calls, stl, trc, zipped)

MARKUPS = {"@schema": "https://x/markups-schema-v1.0.3.json#", "markups": [{
    "type": "Fiducial", "coordinateSystem": "LPS", "coordinateUnits": "mm", "controlPoints": []}]}
ARKIT = b"time_s,jawOpen,mouthSmileLeft,mouthSmileRight,eyeBlinkLeft\n0,0,0,0,0\n0.02,0.5,0.2,1e-1,0.1\n0.05,1,,0,0.5\n"
LIVE_LINK = (b"Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen\n16:07:12:05.613,61,0,0.1\n16:07:12:06.613,61,0.5,0.2\n"
             b"16:07:12:07.613,61,0.5,0.3\n")
OPENFACE = (b"frame, timestamp, confidence, success, AU01_r, AU12_r, AU25_r\n1, 0, 0.96, 1, 0, 0, 0\n"
            b"2, 0.033, 0.96, 1, 0.5, 1.2, 3\n3, 0.067, 0.9, 0, 1, 1, 1\n")
CANDIDE = ("# VERTEX LIST:\n113\n" + "".join(f"{k % 11 - 5} {k // 11 - 5} {k % 7}\n" for k in range(113)) +
           "\n# FACE LIST:\n100\n" + "".join(f"{k} {k + 1} {k + 12}\n" for k in range(100)) +
           "\n# ANIMATION UNITS LIST:\n14\n" + "".join(f"# unit {k}\n2\n{k} 0 0.1 0\n{k + 20} 0 0 0.1\n" for k in range(14)) +
           "\n# SHAPE UNITS LIST:\n1\n# head\n1\n1 0.1 0 0\n\n# ANIMATION PARAMETERS:\n" + "0\n" * 14 +
           "\n# SHAPE PARAMETERS:\n0\n\n# END OF FILE\n").encode()
RICH_SCENE = (
    b'title = "a scene"\nscan = { file = "face.ply", unit = "mm", landmarks = "l.json" }\n'
    b'motion = { file = "in.csv", rest_s = [0], point_gain = [{ point = "ibug68_48", gain = 2 }] }\n'
    b'[mesh]\nelement_size_mm = 12\nlayers = 1\nthickness_point = [{ landmark = "cheek_R", thickness_mm = 12 }]\n'
    b'[tissue]\nyoung_kpa = 1.9e2\nmirror = true\npoint = [{ landmark = "cheek_R", young_kpa = 100 }]\n'
    b'[[tissue.region]]\nname = "cheek_R"\nyoung_factor = 5\n[[tissue.region]]\nscar = ["cheek_R", "cheilion_R"]\n'
    b'width_mm = 8\nyoung_factor = 10\n[drive]\npoints = ["ibug68_48", "ibug68_54", "ibug68_8"]\n'
    b'[muscles]\ngain = { zyg_major_R = 0.5 }\nwithout = ["risorius"]\n[contact]\nlips = true\n'
    b'[time]\nend_s = 0.05\nstep_s = 0.025\nframe_rate_hz = 40\n[output]\npicture_times_s = [0]\nvtu_every = 2\n'
    b'[[variant]]\nname = "stiff"\ntissue = { young_kpa = 400, density_kg_m3 = 1_000 }\n'
    b'[[variant]]\npreset = "palsy_partial_R"\n')
FINITE_SCENE = (
    b'scan.file = "embedded"\nmotion.file = """embedded"""\nmesh.element_size_mm = 14\nmesh.layers = 1\n'
    b'tissue.strain = "finite"\ntissue.law = "yeoh"\ntissue.maxwell = [{ ratio = 0.5, relaxation_s = 0.1 }]\n'
    b'drive.by = "displacement"\ntime.end_s = 0.05\ntime.frame_rate_hz = 40\noutput.vtu = false\n'
    b'support.skull = "held"\nregion.measured = "points"\nregion.measured_points = ["cheek_L"]\noutput.jitter_mm = 0\n')
SURGERY_SCENE = (
    b'scan.file = "embedded"\nmotion.file = "embedded"\ndrive.by = "muscles"\n[output]\nvtu = false\nglb = false\n'
    b'report = false\n[[variant]]\nname = "advanced"\nsurgery.bone = [{ part = "mandible", cut = "bsso", '
    b'move_mm = [0, 1.5, 6], turn_deg = [-2, 0, 1], cut_shift_mm = 3 }, { part = "chin", move_mm = [0, 0, 4] }]\n'
    b'[[variant]]\nname = "filled"\ntissue.mirror = true\ntissue.region = [{ name = "cheek_R", volume_ml = 2 }, '
    b'{ scar = ["cheek_R", "cheilion_R"], width_mm = 8, volume_ml = -0.2 }]\n[[variant]]\nname = "up"\n'
    b'bone = [{ part = "maxilla", move_mm = [0, 3, 0] }, { part = "skull", move_mm = [1, 0, 0] }]\n')
BONES_SCENE = (
    b'scan = { file = "face.ply", unit = "mm", landmarks = "l.json" }\nmotion.file = "embedded"\n'
    b'anatomy = { skull = "bone.ply", mandible = "jaw.ply" }\n[[variant]]\nname = "v"\n'
    b'bone = [{ part = "mandible", move_mm = [0, 0, 6] }]\n')
STUDY = (b'title = "s"\nscene = "s.toml"\nout = "swept"\n[set]\nmesh.element_size_mm = 15\nmesh.layers = 1\n'
         b'time.end_s = 0.05\noutput = { vtu = false, glb = false, report = false, picture_times_s = [0] }\n[grid]\n'
         b'tissue.young_kpa = [50, 1e2]\n[[grid.cheeks]]\nname = "stiff"\n'
         b'tissue.region = [{ name = "cheek_R", young_factor = 10 }]\n')
CASES = b"case,tissue.young_kpa,drive.by,output.vtu\nsoft,50,displacement,false\nstiff,400,,false\n"
VISITS = (b'patient = "P-017"\nexpression = "smile"\nrepetition_mm = 1.5\nrigid_points = ["exocanthion_R", "exocanthion_L",'
          b' "nasion"]\n[[visit]]\ndate = 2026-03-01\nrecording = "in.csv"\nnote = "before"\njitter_mm = 0.2\n'
          b'[[visit]]\ndate = "later"\nrecordings = ["later.csv", "in.trc"]\nend_s = 1\n')
MUSCLES = (b'[[muscle]]\nname = "graft"\nlatin = "temporalis transfer"\npath = ["45 (12, 5) d1", "54 (1, 1) d0.4"]\n'
           b'width_mm = 8\nstraight = true\n[[muscle]]\nname = "zyg_major"\nlatin = "z"\nbranch = "zygomatic"\n'
           b'group = "lip corner elevators"\npath = ["0.6*45 + 0.4*54 (22, 0) d1", "54 (13, 2) d0.3"]\nwidth_mm = 7\n')
SCANNED_VISITS = (
    b'unit = "mm"\nexpression = "mouth open"\n[[visit]]\ndate = 2026-03-01\nrecording = "in.csv"\njitter_mm = 0\n'
    b'rest_scan = "face.ply"\nrest_landmarks = "l.json"\n[[visit]]\ndate = 2026-06-01\nrecording = "in.trc"\n'
    b'jitter_mm = 0.3\nrest_scan = "face.ply"\nrest_landmarks = "l.json"\npeak_scan = "face.ply"\n'
    b'peak_landmarks = "l.json"\n')
REQUESTS = [
    {"do": "open", "what": "started"}, {"do": "undo"}, {"do": "redo"},
    {"do": "set", "changes": {"tissue.young_kpa": 150, "muscles.gain": {"zyg_major_R": .3}}, "face": 0, "live": False,
     "time_s": .02},
    {"do": "set", "changes": {"tissue.region": [{"name": "cheek_R", "young_factor": 3}]}, "face": 0, "live": True,
     "time_s": 0},
    {"do": "set", "changes": {"surgery.bone": [{"part": "chin", "cut": "genioplasty", "move_mm": [0, 1, 4],
                                                "turn_deg": [0, 0, 3], "cut_shift_mm": 2}]}, "face": 0, "live": False},
    {"do": "set", "changes": {"tissue.region": [{"name": "lips", "volume_ml": .5}]}, "face": 0, "live": True, "time_s": 0},
    {"do": "ct_bones", "skull": [0, .045, -.006], "mandible": [0, -.031, .028], "bone_hu": 300},
    {"do": "ct_slice", "axis": 1, "share": .5},
    {"do": "add_variant", "name": "v", "like": 0, "preset": "palsy_partial_R"}, {"do": "remove_variant", "face": 1},
    {"do": "rename_variant", "face": 1, "name": "w"},
    {"do": "paint", "vertices": [1, 2, 300], "shares": [.5, 1, .1]},
    {"do": "region_shares", "region": {"name": "cheek_R"}, "key": "k"},
    {"do": "region_shares", "region": {"scar": ["cheek_R", "cheilion_R"], "width_mm": 5}, "key": "k"},
    {"do": "move_landmark", "name": "cheek_R", "position": [.01, .02, .05]}, {"do": "landmarks_done"},
    {"do": "compare_visits", "name": "v", "expression": "smile"}, {"do": "live_start", "what": "recording", "face": 0},
    {"do": "live_stop"}, {"do": "live_neutral"}, {"do": "live_record", "on": True},
    {"do": "live_drawn", "frame": 3}, {"do": "live_take", "from_s": 0, "to_s": 1},
    {"do": "free_name", "name": "mine"}, {"do": "save", "what": "scene", "name": "mine"},
    {"do": "save", "what": "landmarks", "name": "mine"}, {"do": "discard_autosave"}]
HTTP = [b"GET / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nConnection: close\r\n\r\n",
        b"POST /upload/a%20b.csv HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://127.0.0.1:PORT\r\n"
        b"Authorization: Bearer TOKEN\r\nContent-Length: 5\r\n\r\n1,2,3",
        b"GET /socket HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://127.0.0.1:PORT\r\nUpgrade: websocket\r\n"
        b"Connection: Upgrade\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n"
        b"\x81\x85\0\0\0\0hello"]


class Table:
    def __init__(self, made):
        self.made, self.all = made, []
        sample = os.path.join(made, "sample")
        self.face, self.quad = face_of(read(made, "tracked.glb")), (CORNERS, [(0, 1, 2), (0, 2, 3)])
        # Stands for bones: the face, smaller and farther back.
        self.below = [(.85 * x, .95 * y, z - 12) for x, y, z in self.face[0]], self.face[1]
        self.landmarks = landmarks_of(read(made, "tracked.csv"))
        self.csv = read(made, "run", "motion.csv")
        self.recording = recording_of(os.path.join(sample, "recording"))
        lines = self.recording["associations.txt"].splitlines()
        self.lists = {f"{n}.txt": b"".join(b" ".join(line.split()[2 * k:2 * k + 2]) + b"\n" for line in lines)
                      for k, n in enumerate(("rgb", "depth"))}
        recording = os.path.join(sample, "recording")
        self.truth = {n: b"\n".join(read(recording, n).split(b"\n")[:4]) + b"\n" for n in os.listdir(recording) if n.startswith("truth_")}
        self.colour = next(v for k, v in self.recording.items() if k.startswith("rgb/"))
        self.base = {"s.toml": SCENE, "l.json": json.dumps(self.landmarks).encode(), "face.ply": ply_binary(*self.face),
                     "sound.ply": ply_ascii(*self.quad), "in.csv": self.csv, "later.csv": self.csv,
                     "in.trc": trc(self.csv)}

    def add(self, name, file, seeds, calls, beside=None):
        self.all.append(Format(name, file, seeds, calls, {**self.base, **(beside or {})}))

    def scans(self):
        both = (self.quad, self.face, self.face)
        parts = [gltf_parts(*one) for one in both]
        skin = {"in.mtl": b"newmtl skin\nKd 1 .8 .7\nmap_Kd skin.png\n", "skin.png": png(),
                "beside.bin": parts[1][1]}
        self.add("ply", "in.ply", [ply_binary(*one, order) for one, order in zip(both, "><<")], scan_calls("in.ply"))
        self.add("ply_text", "in.ply", [ply_ascii(*one, colour) for one, colour in zip(both, ("", " 9 8 7", ""))],
                 scan_calls("in.ply"))
        self.add("obj", "in.obj", [obj(*one) for one in both], scan_calls("in.obj"), skin)
        self.add("stl", "in.stl", [stl(*one, text) for one, text in zip(both, (True, False, True))], scan_calls("in.stl"))
        self.add("gltf", "in.gltf", [gltf(parts[0]), gltf(parts[1], "beside.bin"), gltf(parts[1])],
                 scan_calls("in.gltf"), skin)
        self.add("glb", "in.glb", [glb(one) for one in parts], scan_calls("in.glb"), skin)
        self.add("gltf_buffer", "beside.bin", [parts[1][1]], scan_calls("in.gltf"),
                 {**skin, "in.gltf": gltf(parts[1], "beside.bin")})
        coloured = [["new", "in.obj", "embedded", "--out", "new.toml"],
                    ["check", "s.toml", "--set", "scan.file=in.obj", "--set", "scan.landmarks=l.json"],
                    ["run", "s.toml", "--out", "out", "--set", "scan.file=in.obj", "--set", "scan.landmarks=l.json",
                     *COARSE]]
        self.add("mtl", "in.mtl", [skin["in.mtl"], b"newmtl skin\nmap_Kd -s 1 1 1 -o 0 0 skin.png\n"], coloured,
                 {**skin, "in.obj": obj(*self.face)})
        self.add("texture", "skin.png", [png(), png(60, 9), self.colour], coloured[1:],
                 {**skin, "in.obj": obj(*self.face)})
        self.add("searched", "in.ply", [ply_binary(*self.face)],
                 [["landmarks", "in.ply", "--out", "found.json", "--picture", "found.png"]])

    def points(self):
        markups = json.loads(json.dumps(MARKUPS))
        for label, at in list(self.landmarks["points"].items())[:40]:
            markups["markups"][0]["controlPoints"].append({"label": label, "position": at, "positionStatus": "defined"})
        few = dict(list(self.landmarks["points"].items())[10:20])
        for name, file, seeds in (
                ("landmarks", "in.json", [json.dumps(self.landmarks).encode(), json.dumps(
                    {"units": "mm", "points": few}).encode()]),
                ("markups", "in.mrk.json", [json.dumps(markups).encode()])):
            own = ["--set", "scan.file=face.ply", "--set", f"scan.landmarks={file}"]
            self.add(name, file, seeds, [
                ["check", "s.toml", *own], ["mesh", "face.ply", "--landmarks", file, "--out", "m.vtu", "--element-size-mm",
                                            "12", "--layers", "1"], ["run", "s.toml", "--out", "out", *own, *COARSE],
                ["compare", "face.ply", "sound.ply", "--landmarks", file, "--json"]])
        plain = (b"# a comment\r\ntime;" + b";".join(b"x%d;y%d;z%d" % (k, k, k) for k in range(68)) + b"\r\n" + b"".join(
            b"%d" % t + b"".join(b";%.3f;%.3f;%.3f" % (k * .001, k % 7 * .01, t * .001) for k in range(68)) + b"\r\n"
            for t in range(4)))
        for name, file, seeds in (("csv", "in.csv", [self.csv, plain]), ("trc", "in.trc", [trc(self.csv)])):
            self.add(name, file, seeds, [
                ["symmetry", file, "--out", "c.csv", "--excursions", "e.csv"],
                ["symmetry", file, "--keep-head", "--picture", "p.png"], ["new", "embedded", file, "--out", "new.toml"],
                ["check", "s.toml", "--set", f"motion.file={file}"],
                ["run", "s.toml", "--out", "out", "--set", f"motion.file={file}", *COARSE],
                ["visits", "v.toml", "--out", "v.html", "--table", "v.csv"]], {"v.toml": VISITS})
        for name, key, seeds in (("arkit", "arkit", [ARKIT]), ("livelink", "arkit", [LIVE_LINK]),
                                 ("openface", "openface", [OPENFACE])):
            scene = f'scan.file = "embedded"\nmotion.{key} = "w.csv"\n'.encode()
            self.add(name, "w.csv", seeds, [
                ["check", "w.toml"], ["new", "embedded", "w.csv", "--out", "new.toml"],
                ["run", "w.toml", "--out", "out", *COARSE]], {"w.toml": scene})

    def texts(self):
        whole = {"painted.ply": ply_ascii(*self.face, " 255 0 0")}
        self.add("scene", "in.toml", [RICH_SCENE, FINITE_SCENE], [
            ["check", "in.toml"], ["run", "in.toml", "--out", "out", *COARSE], ["run", "in.toml", "--out", "out",
                                                                              "--no-variants", *COARSE]], whole)
        self.add("surgery", "in.toml", [SURGERY_SCENE], [["check", "in.toml"], ["run", "in.toml", "--out", "out", *COARSE]])
        bones = {"bone.ply": ply_binary(*self.below), "jaw.ply": ply_binary(*self.below)}
        self.add("anatomy", "in.toml", [BONES_SCENE], [["check", "in.toml"], ["run", "in.toml", "--out", "out", *COARSE]],
                 bones)
        self.add("anatomy_bone", "bone.ply", [ply_binary(*self.below), ply_ascii(*self.below)], [
            ["check", "b.toml"], ["run", "b.toml", "--out", "out", *COARSE]], {**bones, "b.toml": BONES_SCENE})
        self.add("study", "in.toml", [STUDY, b'scene = "s.toml"\ncases = "cases.csv"\n[set]\ntime.end_s = 0.05\n'], [
            ["sweep", "in.toml", "--list"], ["sweep", "in.toml", "--snakemake"], ["sweep", "in.toml", "--slurm"],
            ["sweep", "in.toml", "--list"], ["sweep", "in.toml", "--collect"]], {"cases.csv": CASES})
        self.add("cases", "cases.csv", [CASES], [["sweep", "in.toml", "--list"], ["sweep", "in.toml", "--snakemake"]],
                 {"in.toml": b'scene = "s.toml"\ncases = "cases.csv"\n'})
        self.add("visits", "in.toml", [VISITS, SCANNED_VISITS], [
            ["visits", "in.toml", "--out", "v.html", "--table", "v.csv"]])
        asks = (["--stiffness", "cheek_L:cheek_R"], ["--gain", "zygomatic_R"])
        self.add("estimate", "in.toml", [SCENE, SCENE + b'drive.points = ["ibug68_48", "ibug68_54", "ibug68_8"]\n'], [
            ["estimate", "in.toml", *one, *COARSE, "--out", "o.json"] for one in asks])
        self.add("estimate_recording", "e.csv", [self.csv], [
            ["estimate", "s.toml", *one, *COARSE, "--out", "o.json"] for one in (
                ["--recording", "e.csv", *asks[0]], ["--lying", "e.csv"], ["--weight", "e.csv:cheilion_R:20"])])
        self.add("muscles", "m.toml", [MUSCLES], [
            ["check", "s.toml", "--set", "muscles.file=m.toml"],
            ["run", "s.toml", "--out", "out", "--set", "drive.by=muscles", "--set", "muscles.file=m.toml", *COARSE]])

    def fields(self):
        rows = [(k % 50 + 1, "" if k % 9 == 0 else 300) for k in range(len(self.face[0]))]
        tissue = ("young_kpa,viscosity_pa_s\n" + "".join(f"{a},{b}\n" for a, b in rows)).encode()
        depth = ("thickness_mm\n" + "".join(f"{a % 20 + 2}\n" for a, _ in rows)).encode()
        lines = ply_ascii(*self.face).decode().replace("element face", "property float young_kpa\nelement face").split("\n")
        first = lines.index("end_header") + 1
        for k, (a, _) in enumerate(rows):
            lines[first + k] += f" {a}"
        share = ("weight\n" + "".join(f"{a / 51:.2f}\n" for a, _ in rows)).encode()
        small = [([tuple(.3 * x for x in p) for p in points], faces) for points, faces in (self.quad, self.face)]
        own = ["--set", "scan.file=face.ply", "--set", "scan.landmarks=l.json"]
        for name, file, seeds, key in (
                ("per_vertex", "f.csv", [tissue], "tissue.per_vertex=f.csv"),
                ("per_vertex_ply", "f.ply", ["\n".join(lines).encode()], "tissue.per_vertex=f.ply"),
                ("thickness", "f.csv", [depth], "mesh.thickness_per_vertex=f.csv"),
                ("painted", "f.ply", [ply_ascii(*self.face, " 255 0 0")],
                 'tissue.region=[{painted="f.ply", young_factor=4}]'),
                ("shares", "f.csv", [share], 'mesh.thickness_region=[{painted="f.csv", thickness_mm=9}]'),
                ("teeth", "t.stl", [stl(*one, False) for one in small], "teeth.upper=t.stl")):
            more = ["--set", "contact.teeth=true"] if name == "teeth" else []
            self.add(name, file, seeds, [["check", "s.toml", *own, "--set", key], [
                "run", "s.toml", "--out", "out", *own, "--set", key, *more, *COARSE]])

    def recordings(self):
        rec = {"rec/" + n: data for n, data in self.recording.items()}
        read_it = [["check", "s.toml", "--set", "motion.recording=rec"], ["new", "embedded", "rec", "--out", "new.toml"],
                   ["track", "rec", "--out", "t.csv"]]
        first = [n for n in rec if n.startswith("rec/rgb/")][0], [n for n in rec if n.startswith("rec/depth/")][0]
        self.add("picture", first[0], [self.colour, png(), png(320, 320)], read_it, rec)
        self.add("depth", first[1], [rec[first[1]], png(320, 320, True)], read_it, rec)
        self.add("camera", "rec/camera.toml", [rec["rec/camera.toml"]], read_it, rec)
        self.add("associations", "rec/associations.txt", [rec["rec/associations.txt"]], read_it, rec)
        lists = {**{n: d for n, d in rec.items() if n != "rec/associations.txt"},
                 **{"rec/" + n: d for n, d in self.lists.items()}}
        self.add("lists", "rec/rgb.txt", [lists["rec/rgb.txt"]], read_it, lists)
        pictures = [d for n, d in self.recording.items() if n.startswith("rgb/")]
        self.add("video", "in.avi", [avi(pictures, 320, 320)], [
            ["check", "s.toml", "--set", "motion.recording=in.avi"], ["new", "embedded", "in.avi", "--out", "new.toml"],
            ["track", "in.avi", "--mirrored", "no", "--out", "t.csv"]])
        for name, data in sorted(self.truth.items()):
            self.add(name[:-4], "rec/" + name, [data], [
                ["track", "--score", "rec", "--json"]], {**rec, **{"rec/" + n: d for n, d in self.truth.items()}})

    def models(self):
        points = {n: [x / 1000 for x in at] for n, at in self.landmarks["points"].items()}
        names = ["jawOpen", "mouthSmileLeft", "mouthSmileRight", "eyeBlinkLeft"]
        own = ["--set", "motion.arkit=w.csv", "--set", "motion.rig=in.glb"]
        rig = gltf_parts(*self.face, names, points)
        self.add("rigged", "l.json", [json.dumps(self.landmarks).encode()], [
            ["rig", "face.ply", "--landmarks", "l.json", "--out", "r.glb", *COARSE[:4]]])
        self.add("rig", "in.glb", [glb(rig), glb(gltf_parts(*self.quad, names, points))], [
            ["symmetry", "w.csv", "--rig", "in.glb"], ["check", "w.toml", *own],
            ["run", "w.toml", "--out", "out", *own, *COARSE]], {"w.csv": ARKIT, "w.toml": b'scan.file = "embedded"\n', "skin.png": png()})
        self.add("candide", "in.wfm", [CANDIDE], [["check", "w.toml", "--set", "motion.candide=in.wfm"]],
                 {"w.csv": ARKIT, "w.toml": b'scan.file = "embedded"\nmotion.arkit = "w.csv"\n'})
        moved = [(self.face[0] if k == 0 else [(x, y - k * (y < -30), z) for x, y, z in self.face[0]], self.face[1])
                 for k in range(3)]
        self.add("series", "frames/1.ply", [ply_binary(*moved[1])], [
            ["symmetry", "frames", "--landmarks", "l.json", "--map", "m.png", "--map-ply", "m.ply"],
            ["symmetry", "frames", "--landmarks", "l.json", "--out", "c.csv"]],
            {f"frames/{k}.ply": ply_binary(*one) for k, one in enumerate(moved)})
        run = {"out/" + n: read(self.made, "run", n) for n in os.listdir(os.path.join(self.made, "run"))
               if os.path.isfile(os.path.join(self.made, "run", n))}
        self.add("run_summary", "out/summary.json", [run["out/summary.json"]], [
            ["symmetry", "out"], ["run", "s.toml", "--out", "out", *COARSE]], run)
        self.add("run_skin", "out/skin_peak.ply", [run["out/skin_peak.ply"]], [
            ["compare", "out/skin_peak.ply", "out/skin_peak.ply", "--corresponding", "--json"]], run)

    def scanners(self):
        values, labels = ct.head()
        slices = {"series/" + name: data for name, data in ct.series(values).items()}
        volume, bones = {"head.nrrd": ct.nrrd(values)}, [ct.blocks(labels, one) for one in (ct.SKULL, ct.MANDIBLE)]

        def calls(name, *more):
            return [["ct", name, "--out", "out", *more]]
        self.add("ct_slice", "series/15.dcm", [ct.dicom(values, 15, way) for way in (
            ct.EXPLICIT, ct.IMPLICIT, ct.RUN_LENGTHS, ct.LOSSLESS_JPEG)], calls("series") * 3 + calls(
                "series", "--seed-skull", "0,45,-6", "--seed-mandible", "0,-31,28"), slices)
        self.add("ct_zip", "in.zip", [zipped(slices, way) for way in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)],
                 calls("in.zip"), {"tmp/in_use": b""})
        for name, file, seeds in (
                ("ct_nrrd", "in.nrrd", [ct.nrrd(values, way) for way in ("raw", "ascii", "gzip")]),
                ("ct_nifti", "in.nii", [ct.nifti(values)]),
                ("ct_nifti_gz", "in.nii.gz", [gzip.compress(ct.nifti(values), mtime=0)])):
            self.add(name, file, seeds, calls(file) + calls(file, "--skin-hu", "-400", "--bone-hu", "250"))
        self.add("ct_labels", "labels.nrrd", [ct.nrrd(labels, way) for way in ("raw", "gzip")],
                 calls("head.nrrd", "--labels", "labels.nrrd"), volume)
        self.add("ct_labels_nifti", "labels.nii", [ct.nifti(labels)], calls("head.nrrd", "--labels", "labels.nii"), volume)
        own = {**volume, "mandible.ply": ply_binary(*bones[1])}
        for file, seeds in (("skull.stl", [stl(*bones[0], text) for text in (True, False)]),
                            ("skull.ply", [ply_ascii(*bones[0]), ply_binary(*bones[0])])):
            self.add("ct_bones_" + file[-3:], file, seeds, calls(
                "head.nrrd", "--skull", file, "--mandible", "mandible.ply"), own)

    def kept(self):
        cache = os.path.join(self.made, "cache", "hyperex")
        for kind in ("face-", "completed-", "order-"):
            names = [n for n in sorted(os.listdir(cache)) if n.startswith(kind)] if os.path.isdir(cache) else []
            if names:
                beside = {"cache/hyperex/" + n: read(cache, n) for n in os.listdir(cache) if n.endswith(".kept")}
                self.add("kept_" + kind[:-1], "cache/hyperex/" + names[0], [read(cache, names[0])],
                         [["run", "s.toml", "--out", "out", "--set", "drive.by=displacement", *COARSE]], beside)

    def studio(self):
        rec = {**{n: d for n, d in self.recording.items() if n != "associations.txt"}, **self.lists}
        self.add("studio_zip", "in.zip", [zipped(rec, zipfile.ZIP_STORED), zipped(rec, zipfile.ZIP_DEFLATED)], ["open"])
        self.add("studio_scan", "in.ply", [ply_binary(*self.face), ply_ascii(*self.face)], ["open"])
        self.add("studio_recording", "in.csv", [self.csv], ["open"])
        self.add("studio_scene", "in.toml", [RICH_SCENE], ["open"])
        self.add("studio_left", "scene.toml", [RICH_SCENE], ["left"])
        self.add("studio_requests", "", [json.dumps({"id": 1, **r}).encode() for r in REQUESTS], ["send"])
        self.add("studio_http", "", HTTP, ["raw"])


def formats(made):
    table = Table(made)
    for part in (table.scans, table.points, table.texts, table.fields, table.recordings, table.models, table.scanners,
                 table.kept, table.studio):
        part()
    return {one.name: one for one in table.all}
