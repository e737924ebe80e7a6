# SPDX-License-Identifier: GPL-3.0-or-later
import logging
import os
import tempfile
import unittest
import warnings

import numpy as np

import hyperex
from support import coarse_mesh, face


class Motions(unittest.TestCase):
    def setUp(self):
        self.names = ["a", "b"]
        self.times = [0, 0.1, 0.25]
        self.positions = np.arange(18.0).reshape(3, 2, 3) / 100

    def test_from_arrays(self):
        motion = hyperex.Motion(self.names, self.times, self.positions)
        self.assertEqual(motion.names, self.names)
        np.testing.assert_array_equal(motion.time_s, self.times)
        np.testing.assert_array_equal(motion.positions_m, self.positions)
        np.testing.assert_array_equal(motion["b"], self.positions[:, 1])
        np.testing.assert_allclose(motion.at(0.05), self.positions[:2].mean(axis=0))
        self.assertEqual(len(motion), 3)
        self.assertTrue("a" in motion and "c" not in motion)
        with self.assertRaises(KeyError):
            motion["c"]

    def test_through_a_file(self):
        motion = hyperex.Motion(self.names, self.times, self.positions)
        with tempfile.TemporaryDirectory() as folder:
            hyperex.write_motion_csv(f"{folder}/m.csv", motion)
            again = hyperex.read_motion(f"{folder}/m.csv")
        self.assertEqual(again.names, self.names)
        np.testing.assert_allclose(again.positions_m, self.positions, atol=1e-9)

    def test_refused(self):
        for arguments, message in (
                ((["a", "a"], self.times, self.positions), "names = a: expected each name once"),
                ((self.names, [0, 0.2, 0.2], self.positions), "expected rising numbers"),
                ((self.names, [0, float("nan"), 1], self.positions), "expected rising numbers"),
                ((self.names, self.times, self.positions[:, :1]),
                 r"positions_m = .*\(3, 1, 3\): expected \(3, 2, 3\)"),
                (([], self.times, np.zeros((3, 0, 3))), "at least one point")):
            with self.subTest(message), self.assertRaisesRegex(hyperex.InputError, message):
                hyperex.Motion(*arguments)

    def test_gaps(self):
        self.positions[1, 0] = np.nan
        motion = hyperex.Motion(self.names, self.times, self.positions)
        np.testing.assert_allclose(hyperex.fill_gaps(motion, max_gap_s=0.3)["a"][1],
                                   [0.048, 0.058, 0.068])
        with self.assertRaisesRegex(hyperex.InputError, "a"):
            hyperex.fill_gaps(motion, max_gap_s=0.1)


class WildReadings(unittest.TestCase):
    """A corner of the mouth is off in some readings."""

    def prepared(self, off_m, first, last):
        motion = hyperex.embedded_mouth_opening(face().landmarks)
        positions = motion.positions_m.copy()
        positions[first:last, motion.names.index("cheilion_L"), 2] += off_m
        return hyperex.prepare_motion(
            hyperex.Motion(motion.names, motion.time_s, positions), face().landmarks)

    def farthest_mm(self, prepared):
        path = prepared.motion["cheilion_L"]
        return 1e3 * np.linalg.norm(path - path[0], axis=1).max()

    def test_one_is_left_out_with_a_warning(self):
        sound = self.farthest_mm(self.prepared(0, 0, 0))
        with self.assertWarnsRegex(UserWarning, "jumps away and back"):
            mended = self.prepared(0.3, 8, 9)
        self.assertLess(abs(self.farthest_mm(mended) - sound), 2)

    def test_so_are_four(self):
        sound = self.farthest_mm(self.prepared(0, 0, 0))
        with self.assertWarnsRegex(UserWarning, "4 such readings"):
            mended = self.prepared(0.01, 6, 10)
        self.assertLess(abs(self.farthest_mm(mended) - sound), 2)

    def test_seven_are_refused(self):
        with self.assertRaisesRegex(hyperex.InputError, "expected at most"):
            self.prepared(0.3, 6, 13)

    def test_a_point_that_goes_too_far_is_named(self):
        with self.assertWarnsRegex(UserWarning, "cheilion_L: 38 mm"):
            self.prepared(0.06, 8, 40)


class TinyMotion(unittest.TestCase):
    """Displacements as if kilometres had been given as metres."""

    def prepared(self, factor):
        motion = hyperex.embedded_mouth_opening(face().landmarks)
        rest_m = motion.positions_m[:1]
        positions_m = rest_m + factor * (motion.positions_m - rest_m)
        return hyperex.prepare_motion(hyperex.Motion(motion.names, motion.time_s, positions_m),
                                      face().landmarks)

    def test_is_warned_of_once(self):
        with self.assertWarnsRegex(UserWarning, "nothing moves.*check its unit") as warned:
            self.prepared(1e-3)
        self.assertEqual(len(warned.warnings), 1)

    def test_one_that_moves_or_is_meant_to_be_still_is_not(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.prepared(1)
            self.prepared(0)


class HeadPose(unittest.TestCase):
    def test_points_that_hold_it_and_a_head_that_is_still_are_refused(self):
        motion = hyperex.embedded_mouth_opening(face().landmarks)
        with self.assertRaisesRegex(hyperex.InputError,
                                    "rigid_points = ibug68_27, ibug68_36, ibug68_45: expected none"):
            hyperex.prepare_motion(motion, face().landmarks, still_head=True,
                                   rigid_points=["ibug68_27", "ibug68_36", "ibug68_45"])


class Files(unittest.TestCase):
    def test_same_message_as_the_program(self):
        with self.assertRaisesRegex(hyperex.InputError, "^no_such.ply: "):
            hyperex.read_scan("no_such.ply")
        with self.assertRaisesRegex(hyperex.InputError, "unit = ell: expected mm, cm or m"):
            hyperex.read_scan("no_such.ply", unit="ell")

    def test_a_scan_and_its_landmarks_through_files(self):
        with tempfile.TemporaryDirectory() as folder:
            height_mm = 1e3 * face().mesh.points_m[:, 1]
            hyperex.write_ply(f"{folder}/s.ply", face().mesh, scalars={"height_mm": height_mm})
            hyperex.write_landmarks(f"{folder}/l.json", face().landmarks)
            again = hyperex.read_face(f"{folder}/s.ply", f"{folder}/l.json")
            self.assertRaises(hyperex.InputError, hyperex.write_ply, f"{folder}/t.ply",
                              face().mesh, scalars={"height_mm": height_mm[:-1]})
        self.assertEqual(again.scan.unit, "mm")
        self.assertEqual(again.placed, [])
        np.testing.assert_allclose(again.mesh.points_m, face().mesh.points_m, atol=1e-7)
        np.testing.assert_array_equal(again.mesh.triangles, face().mesh.triangles)
        np.testing.assert_allclose(again.landmarks["cheilion_L"], face().landmarks["cheilion_L"])

    def test_landmarks_are_completed(self):
        few = {name: face().landmarks[name] for name in
               ("exocanthion_L", "exocanthion_R", "cheilion_L", "cheilion_R", "pronasale")}
        completed = hyperex.Face(face().scan, few)
        self.assertIn("ibug68_8", completed.placed)
        off = np.linalg.norm(completed.landmarks["ibug68_8"] - face().landmarks["ibug68_8"])
        self.assertLess(off, 0.01)

    def test_remarks_go_to_the_logger(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(f"{folder}/s.obj", "w") as file:
                file.write("mtllib gone.mtl\n")
                for x, y, z in face().mesh.points_m:
                    file.write(f"v {1e3 * x} {1e3 * y} {1e3 * z}\n")
                for a, b, c in face().mesh.triangles + 1:
                    file.write(f"f {a} {b} {c}\n")
            with self.assertLogs("hyperex", logging.INFO) as said:
                hyperex.read_scan(f"{folder}/s.obj")
        self.assertIn("gone.mtl", " ".join(said.output))


class Meshes(unittest.TestCase):
    def test_refused(self):
        with self.assertRaisesRegex(hyperex.InputError, "triangles"):
            hyperex.TriMesh(np.zeros((3, 3)), [[0, 1, 3]])
        for options, message in ((dict(element_size_m=1), "element_size_m = 1: expected a number "
                                  "from 0.0005 to 0.03"),
                                 (dict(thickness_m=1e-5), "0, or 0.001 to 0.04"),
                                 (dict(layers=0), "layers = 0")):
            with self.subTest(message), self.assertRaisesRegex(hyperex.InputError, message):
                hyperex.build_tissue_mesh(face(), hyperex.TissueMeshOptions(**options))

    def test_thickness_of_files(self):
        vertices = len(face().mesh.points_m)
        with tempfile.TemporaryDirectory() as folder:
            def file(name, column, value):
                path = os.path.join(folder, name)
                with open(path, "w") as out:
                    out.write("\n".join([column] + [str(value)] * vertices))
                return path
            plain = dict(element_size_m=0.01, layers=1)
            each = file("each.csv", "thickness_mm", 9)
            mesh = hyperex.build_tissue_mesh(face(), hyperex.TissueMeshOptions(depth_per_vertex=each, **plain))
            self.assertAlmostEqual(np.median(mesh.thickness_m), 0.009, 9)
            half = hyperex.DepthRegion(painted=file("half.csv", "weight", 0.5), depth_m=0.005)
            mesh = hyperex.build_tissue_mesh(face(), hyperex.TissueMeshOptions(
                depth_per_vertex=each, depth_regions=[half], **plain))
            self.assertAlmostEqual(np.median(mesh.thickness_m), 0.007, 9)
            with self.assertRaisesRegex(hyperex.InputError, "thickness_mm = 90 at vertex 0"):
                hyperex.build_tissue_mesh(face(), hyperex.TissueMeshOptions(
                    depth_per_vertex=file("each.csv", "thickness_mm", 90), **plain))
            with self.assertRaisesRegex(hyperex.InputError, "depth_m = 1: expected a number"):
                hyperex.build_tissue_mesh(face(), hyperex.TissueMeshOptions(
                    depth_regions=[half.replace(depth_m=1)], **plain))

    def test_tetrahedra_have_positive_volume(self):
        mesh = coarse_mesh()
        a, b, c, d = (mesh.nodes_m[mesh.tets[:, k]] for k in range(4))
        self.assertGreater(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).min(), 0)


class Options(unittest.TestCase):
    def test_classes(self):
        options = hyperex.SimulationOptions()
        options.support.skull_layer.across_pa_per_m = 2e7
        self.assertEqual(options.support.skull_layer.across_pa_per_m, 2e7)
        self.assertNotEqual(options, hyperex.SimulationOptions())
        again = eval(repr(options), vars(hyperex))
        self.assertEqual(again, options)
        self.assertEqual(options.replace(tissue=hyperex.Tissue(young_pa=1e4)).tissue.young_pa, 1e4)
        self.assertEqual(options.tissue.young_pa, 192.4e3)

    def test_refused(self):
        with self.assertRaisesRegex(TypeError, "Tissue has no field young; it has young_pa"):
            hyperex.Tissue(young=1)
        with self.assertRaisesRegex(hyperex.InputError,
                                    "skull = tied: expected one of sliding, held, free"):
            hyperex.SupportOptions(skull="tied")
        with self.assertRaisesRegex(TypeError, "gain: a value of type str"):
            hyperex.DriveOptions(gain="much")
        with self.assertRaisesRegex(TypeError, "points: expected a list, not one string"):
            hyperex.DriveOptions(points="ibug68_8")

    def test_tissue_out_of_the_bounds_of_a_scene_is_refused_when_it_is_made(self):
        for given, said in (({"young_pa": -1}, r"tissue.young_pa = -1: expected a number from 1 to 1e\+09 Pa"),
                            ({"young_pa": float("nan")}, "tissue.young_pa = nan: expected a number from 1 to"),
                            ({"young_pa": [1e5, 0]}, "tissue.young_pa = 0: expected numbers from 1 to"),
                            ({"poisson": 0.5}, "tissue.poisson = 0.5: expected a number from -0.99 to 0.4999"),
                            ({"density_kg_m3": 0}, "tissue.density_kg_m3 = 0: expected a number from 0.001"),
                            ({"volume_ratio": [1, -1]}, "tissue.volume_ratio = -1: expected positive numbers")):
            with self.assertRaisesRegex(ValueError, said):
                hyperex.Tissue(**given)
        tissue = hyperex.Tissue(young_pa=1e4)
        with self.assertRaises(hyperex.InputError):
            tissue.young_pa = -1
        self.assertEqual(tissue.young_pa, 1e4)
        tissue.young_pa = np.float32(2e4)
        self.assertEqual(tissue.young_pa, 2e4)

    def test_kilopascals_for_pascals_are_told(self):
        with self.assertWarnsRegex(UserWarning, r"young_pa = 100 Pa: expected pascals; 100 kPa are 100000 Pa"):
            hyperex.Tissue(young_pa=100)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            hyperex.Tissue(young_pa=[100, 1e5], viscosity_pa_s=100)


if __name__ == "__main__":
    unittest.main()
