# SPDX-License-Identifier: GPL-3.0-or-later
import json
import pathlib
import tempfile
import unittest

import numpy as np

import hyperex
from support import DEMO, SOURCE, coarse_mesh, face, small_simulator

EXAMPLES = SOURCE / "examples"
COARSE = {"mesh.element_size_mm": 10, "mesh.layers": 1}


class Scenes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_run_scene_writes_what_the_program_does(self):
        summary = hyperex.run_scene(EXAMPLES / "mouth_open.toml", self.folder / "out",
                                    {"output.vtu": False, "output.glb": False,
                                     "output.report": False,
                                     "drive.by": "displacement"})
        for name in ("motion.csv", "symmetry.csv", "excursions.csv", "skin_peak.ply"):
            self.assertEqual((self.folder / "out" / name).read_bytes(),
                             (DEMO / name).read_bytes(), name)
        written = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(written, summary)

    def test_scene_by_parts(self):
        scene = hyperex.Scene(EXAMPLES / "variants.toml", COARSE)
        self.assertEqual(scene.face.scan.file, pathlib.Path("embedded face"))
        self.assertEqual(list(scene.variants), ["stiffer", "more viscous", "softer under the skin",
                                                "stiff right cheek", "scar beside the mouth"])
        self.assertEqual(scene.variants["stiffer"].tissue.young_pa, 1e6)
        self.assertEqual(len(scene.variants["stiff right cheek"].tissue.young_pa),
                         len(scene.mesh.tets))
        simulator = scene.simulator()
        base = simulator.run()
        np.testing.assert_array_equal(base.skin_displacement_m,
                                      small_simulator().run().skin_displacement_m)
        simulator.set_options(scene.variants["stiff right cheek"])
        difference = hyperex.variant_difference(base, simulator.run())
        side = base.skin_rest.points_m @ (face().landmarks["cheek_L"] - face().landmarks["cheek_R"])
        right = side < np.median(side)
        self.assertGreater(difference.greatest_m[right].mean(),
                           5 * difference.greatest_m[~right].mean())

    def test_changes_that_cannot_be(self):
        with self.assertRaisesRegex(hyperex.InputError, "tissue.young_kpa = -3: expected"):
            hyperex.run_scene(EXAMPLES / "mouth_open.toml", self.folder / "out", {"tissue.young_kpa": -3})
        self.assertFalse((self.folder / "out").exists())
        with self.assertRaisesRegex(hyperex.InputError, "tisue"):
            hyperex.check_scene(EXAMPLES / "mouth_open.toml", {"tisue.young_kpa": 3})

    def test_a_law_needs_finite_strain(self):
        with self.assertLogs("hyperex", "WARNING"):
            scene = hyperex.Scene(EXAMPLES / "mouth_open.toml", {"tissue.law": "yeoh", **COARSE})
        self.assertTrue(any("tissue.law" in warning for warning in scene.warnings))
        law = hyperex.Law(name="yeoh", c20=0.6, maxwell=[hyperex.MaxwellBranch(ratio=0.5)])
        self.assertEqual(hyperex.ModelOptions(strain="finite", law=law).law.maxwell[0].ratio, 0.5)
        options = hyperex.SimulationOptions(model=hyperex.ModelOptions(law=law))
        simulator = small_simulator()
        with self.assertLogs("hyperex", "WARNING") as log:
            simulator.set_options(options)
        self.assertIn("model.law = yeoh has no effect", log.output[0])
        options.model.strain = "finite"
        simulator.set_options(options)
        self.assertEqual(simulator.options.model.law, law)

    def test_check(self):
        checked = hyperex.check_scene(EXAMPLES / "mouth_open.toml")
        self.assertEqual(checked["warnings"], [])
        aligned = next(r for r in checked["remarks"] if r["id"] == "recording.aligned")
        self.assertEqual((aligned["severity"], aligned["key"]), ("note", "alignment.method"))
        self.assertIn("92", aligned["text"])
        self.assertEqual(checked["notes"], [remark["text"] for remark in checked["remarks"]])
        drive = next(r["text"] for r in checked["remarks"] if r["id"] == "drive.chosen")
        self.assertEqual(drive, "driven by muscles: nothing in the scene says otherwise")
        face = hyperex.FaceSession(EXAMPLES / "mouth_open.toml", COARSE)
        self.assertIn(drive, [note.text for note in face.notes()])


class TissueFields(unittest.TestCase):
    def test_as_the_scene(self):
        scene = hyperex.Scene(EXAMPLES / "stiff_cheek.toml", COARSE)
        options = hyperex.TissueFieldOptions(regions=[
            hyperex.TissueRegion(name="cheek_R", young_factor=5, blend_m=0.006)])
        self.assertEqual(hyperex.tissue_field(coarse_mesh(), face(), options).young_pa.tolist(),
                         scene.options.tissue.young_pa.tolist())

    def test_layers(self):
        options = hyperex.TissueFieldOptions(layers=[
            hyperex.TissueLayer(name="skin", thickness_m=0.002, young_factor=5), hyperex.TissueLayer(name="deep")])
        young = hyperex.tissue_field(coarse_mesh(), face(), options).young_pa
        self.assertTrue(192.4e3 < young.min() < young.max() <= 5 * 192.4e3)
        options.layers = [hyperex.TissueLayer(thickness_m=2, young_factor=5)]   # millimetres for metres
        with self.assertRaisesRegex(hyperex.InputError, r"tissue.layer\[0\].thickness_mm"):
            hyperex.tissue_field(coarse_mesh(), face(), options)

    def test_added_volume(self):
        options = hyperex.TissueFieldOptions(regions=[
            hyperex.TissueRegion(name="cheek_R", volume_m3=2e-6)])
        tissue = hyperex.tissue_field(coarse_mesh(), face(), options)
        self.assertGreater(tissue.volume_ratio.max(), 1.05)
        self.assertEqual(tissue.volume_ratio.min(), 1)
        self.assertIsNone(hyperex.Tissue().volume_ratio)
        tissue.volume_ratio = [1, 2]
        with self.assertRaisesRegex(hyperex.InputError, "tissue.volume_ratio"):
            small_simulator().set_tissue(tissue)
        tissue.volume_ratio = None
        self.assertIsNone(tissue.volume_ratio)


    def test_refused(self):
        options = hyperex.TissueFieldOptions(regions=[
            hyperex.TissueRegion(name="elbow", young_factor=5)])
        with self.assertRaisesRegex(hyperex.InputError, r"tissue.region\[0\].name"):
            hyperex.tissue_field(coarse_mesh(), face(), options)


class Measures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.performance = small_simulator().run()

    def test_excursions(self):
        moved = self.performance.landmarks["cheilion_L"]
        corners = hyperex.excursions_of(self.performance.landmarks)["cheilion"]
        far_mm = 1e3 * np.linalg.norm(moved - moved[0], axis=1)
        self.assertAlmostEqual(corners.left.excursion_mm, far_mm.max(), 9)
        np.testing.assert_allclose(
            hyperex.distance_from_rest_mm(self.performance.landmarks, ["cheilion_L"]), far_mm, atol=1e-12)
        with self.assertRaises(hyperex.InputError):
            hyperex.distance_from_rest_mm(self.performance.landmarks, ["nobody"])

    def test_change_of_an_excursion_and_its_band(self):
        scene = hyperex.Scene(EXAMPLES / "mouth_open.toml", COARSE)
        simulator = scene.simulator()
        twin = hyperex.Simulator(scene.mesh, scene.face.landmarks, scene.mirrored_motion, scene.options)

        def pairs(factor):
            options = scene.options
            options.tissue = options.tissue.replace(young_pa=factor * scene.options.tissue.young_pa)
            for one in (simulator, twin):
                one.set_options(options)
            return hyperex.excursions_of(simulator.run().landmarks, 1e-4, twin=twin.run().landmarks)

        soft, stiff = pairs(1), pairs(3)
        for side in "LR":
            change = hyperex.change_of(soft["cheek"], stiff["cheek"], side)
            before, after = (getattr(p["cheek"], {"L": "left", "R": "right"}[side]).excursion_mm
                             for p in (soft, stiff))
            self.assertAlmostEqual(change.change_mm, after - before, 12)
            self.assertGreater(change.band_mm, 0.1)
            self.assertEqual(change.decided, abs(change.change_mm) > change.band_mm)
        with self.assertWarns(DeprecationWarning):
            hyperex.change_of(soft["cheek"], stiff["cheek"], "L", 1e-4)
        alone = hyperex.excursions_of(simulator.run().landmarks)["cheek"]
        self.assertTrue(np.isnan(hyperex.change_of(alone, alone, "L").band_mm))
        self.assertIsNone(hyperex.change_of(alone, alone, "L").decided)
        self.assertIs(alone.decided, True)
        self.assertEqual(soft["cheek"].decided, not soft["cheek"].undecided)
        with self.assertRaisesRegex(hyperex.InputError, "side"):
            hyperex.change_of(alone, alone, "left")
        with self.assertRaisesRegex(hyperex.InputError, "twin"):
            hyperex.excursions_of(scene.motion.motion, twin=hyperex.Motion(["a"], [0, 1], np.zeros((2, 1, 3))))

    def test_symmetry(self):
        curve = hyperex.symmetry_of(self.performance.landmarks)
        self.assertEqual(len(curve.s), len(self.performance.frame_time_s))
        expected = np.log(np.maximum(np.abs(curve.xi_left - curve.xi_right), 1e-6))
        np.testing.assert_allclose(curve.s, expected, atol=1e-12)

    def test_asymmetry(self):
        asymmetry = hyperex.asymmetry_of(self.performance, face().landmarks)
        values = hyperex.asymmetry_map_mm(self.performance, asymmetry, asymmetry.worst_frame)
        self.assertEqual(len(values), len(self.performance.skin_rest.points_m))
        self.assertEqual(asymmetry.worst_frame, int(np.argmax(asymmetry.face_rms_mm)))
        self.assertAlmostEqual(abs(asymmetry.plane_normal[0]), 1, 3)
        with self.assertRaises(IndexError):
            hyperex.asymmetry_map_mm(self.performance, asymmetry, 10**6)

    def test_distances(self):
        points = face().mesh.points_m
        distance_m = hyperex.distance_to_surface(points + [0, 0, 1e-4], face().mesh)
        self.assertLess(distance_m.max(), 1e-4 + 1e-12)
        statistics = hyperex.statistics_of(distance_m)
        self.assertAlmostEqual(statistics.mean_mm, 1e3 * distance_m.mean(), 9)
        lips = hyperex.regions_of(points, face().landmarks)["lips"]
        self.assertAlmostEqual(hyperex.statistics_of(distance_m, lips).max_mm,
                               1e3 * distance_m[lips].max(), 9)
        with self.assertRaises(IndexError):
            hyperex.statistics_of(distance_m, [len(points)])


class Export(unittest.TestCase):
    def test_glb(self):
        run = small_simulator().run()
        with tempfile.TemporaryDirectory() as folder:
            report = hyperex.write_glb(f"{folder}/f.glb", run, face().scan)
            size = pathlib.Path(f"{folder}/f.glb").stat().st_size
        self.assertEqual(report.bytes, size)
        self.assertLessEqual(report.max_error_m, 1e-4)
        self.assertGreater(report.keys, 1)


if __name__ == "__main__":
    unittest.main()
