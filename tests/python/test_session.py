# SPDX-License-Identifier: GPL-3.0-or-later
import pathlib
import re
import tempfile
import unittest

import numpy as np

import hyperex
from support import SOURCE

EXAMPLES = SOURCE / "examples"
COARSE = {"mesh.element_size_mm": 10, "mesh.layers": 1, "time.frame_rate_hz": 5}


class FaceSessions(unittest.TestCase):
    def test_the_same_calls_have_the_same_names_as_in_cpp(self):
        header = (SOURCE / "src/hyperex/session/face_session.hpp").read_text()
        front = header[header.rindex("namespace hyperex {"):]
        names = re.findall(r"using \w+::(\w+);", front)
        self.assertIn("FaceSession", names)
        for name in names:
            if name != "Value":  # Python has values of its own
                self.assertTrue(hasattr(hyperex, name), name)
        section = header[header.index("// ----- changes and their results"):header.index("// ----- stage by stage")]
        calls = re.findall(r"^  [\w:<>& ]+ (\w+)\(", section, re.M)
        self.assertEqual(set(calls), {"run", "set", "variant", "performance", "measures", "notes", "warnings"})
        for call in calls:
            self.assertTrue(callable(getattr(hyperex.FaceSession, call)), call)

    def test_what_if(self):
        face = hyperex.FaceSession(EXAMPLES / "stiff_cheek.toml", {"drive.by": "muscles", **COARSE})
        before = face.run()
        face.set("tissue.region[0].young_factor", 50)
        after = face.run()
        self.assertEqual(before.name, "base")
        self.assertFalse(np.array_equal(before.performance().skin_displacement_m,
                                        after.performance().skin_displacement_m))
        np.testing.assert_array_equal(face.performance().skin_displacement_m,
                                      after.performance().skin_displacement_m)
        self.assertGreater(after.measures().excursions["cheilion"].left.excursion_mm, 0)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            hyperex.write_glb(folder / "after.glb", after)
            hyperex.write_skin_ply(folder / "after.ply", after)
            hyperex.write_motion_csv(folder / "after.csv", after)
            self.assertEqual((folder / "after.glb").read_bytes()[:4], b"glTF")
            self.assertEqual(hyperex.read_motion(folder / "after.csv").names[:3],
                             after.performance().landmarks.names[:3])
        with self.assertRaisesRegex(hyperex.InputError, "^tissue.young_kpa = -3"):
            face.set("tissue.young_kpa", -3)
        with self.assertRaisesRegex(hyperex.InputError,
                                    'variant odd: muscles.gain.zyg_major_L = "nan": expected'):
            face.variant("odd", {"muscles.gain": {"zyg_major_L": float("nan")}})
        with self.assertRaisesRegex(hyperex.InputError, '^tissue.young_kpa = "inf"'):
            face.set("tissue.young_kpa", np.float32("inf"))
        with self.assertRaisesRegex(TypeError, "not JSON serializable"):
            face.set("tissue.young_kpa", object())
        face.set("tissue.young_kpa", np.float32(150))
        face.set("tissue.region[0].young_factor", np.int64(40))

    def test_the_eyes_turn_with_the_gaze(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "look.csv").write_text("time_s,jawOpen,eyeLookOutLeft,eyeLookInRight,eyeLookDownLeft\n"
                                             "0,0,0,0,0\n0.4,0.1,1,0.5,0.2\n0.6,0.1,1,0.5,0.2\n")
            (folder / "look.toml").write_text('scan.file = "embedded"\nmotion.arkit = "look.csv"\n')
            coarse = {**COARSE, "drive.by": "displacement"}
            gaze = hyperex.FaceSession(folder / "look.toml", coarse).performance().gaze
            hyperex.run_scene(folder / "look.toml", folder / "out", coarse)
            table = np.genfromtxt(folder / "out/gaze.csv", delimiter=",", names=True)
        self.assertEqual(table.dtype.names[0], "time_s")
        self.assertEqual(set(table.dtype.names[1:]), set(gaze))
        for name, degrees in gaze.items():
            np.testing.assert_allclose(degrees, table[name], err_msg=name)
        self.assertEqual(gaze["eye_yaw_L_deg"][0], 0)
        self.assertAlmostEqual(gaze["eye_yaw_L_deg"][2], 35)  # to the subject's left
        self.assertAlmostEqual(gaze["eye_yaw_R_deg"][2], 17.5)
        self.assertAlmostEqual(gaze["eye_pitch_L_deg"][2], -7)
        other = hyperex.FaceSession(EXAMPLES / "stiff_cheek.toml", coarse)
        self.assertEqual(other.performance().gaze, {})

    def test_error_budget(self):
        session = hyperex.FaceSession(EXAMPLES / "demo.toml", {**COARSE, "mesh.layers": 2})
        shares = []
        budget = session.error_budget(progress=shares.append)
        change = next(f for f in budget["corners_of_the_mouth"] if f.get("variant") and f["side"] == "R")
        self.assertEqual(change["figure"], "change")
        self.assertGreater(change["half_width_95_mm"], 0)
        self.assertIn(change["largest_part"], change["parts_mm"])
        self.assertTrue(budget["assumed"] and budget["sentences"])
        self.assertEqual(shares, sorted(shares))
        with self.assertRaises(hyperex.Cancelled):
            session.error_budget(cancelled=lambda: True)

    def test_expected_error(self):
        face = hyperex.FaceSession(EXAMPLES / "stiff_cheek.toml", {"drive.by": "muscles", **COARSE})
        face.run()
        self.assertEqual(face.expected_error_mm.shape, face.performance().skin_displacement_m.shape[1:2])
        self.assertGreater(face.expected_error_mm.min(), 0)
        self.assertGreater(face.uncertainty["lips"]["determined"], face.uncertainty["eyes"]["determined"])
        cheeks = face.uncertainty["cheeks"]["distance_rms_mm"]
        self.assertTrue(face.expected_error_mm.min() < cheeks < face.expected_error_mm.max())
        face = hyperex.FaceSession(EXAMPLES / "stiff_cheek.toml", {"drive.by": "displacement", **COARSE})
        face.run()
        self.assertIsNone(face.expected_error_mm)
        self.assertIsNone(face.uncertainty)

    def test_from_memory(self):
        face = hyperex.embedded_face()
        session = hyperex.FaceSession(face, hyperex.embedded_mouth_opening(face.landmarks), COARSE)
        self.assertGreater(session.run().performance().report.lip_gap_mm, 5)

    def test_a_law_at_small_strain_is_a_warning_as_everywhere(self):
        with self.assertLogs("hyperex", "WARNING") as log:
            session = hyperex.FaceSession(EXAMPLES / "mouth_open.toml", {"tissue.law": "yeoh", **COARSE})
        self.assertIn("law.idle", [note.id for note in session.warnings()])
        self.assertTrue(any("tissue.law" in line for line in log.output))


if __name__ == "__main__":
    unittest.main()
