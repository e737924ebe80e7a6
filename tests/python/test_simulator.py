# SPDX-License-Identifier: GPL-3.0-or-later
import copy
import gc
import re
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import hyperex
from support import DEMO, SOURCE, coarse_mesh, face, mesh, motion, small_simulator


class SameNumbers(unittest.TestCase):
    """To the bit: files that both write are compared byte by byte."""

    @classmethod
    def setUpClass(cls):
        options = hyperex.SimulationOptions(time=hyperex.TimeOptions(step_s=0.002, end_s=2.7))
        cls.simulator = hyperex.Simulator(mesh(), face().landmarks, motion(), options)
        cls.performance = cls.simulator.run()

    def test_as_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            hyperex.write_motion_csv(f"{folder}/motion.csv", self.performance.landmarks)
            with open(f"{folder}/motion.csv", "rb") as file:
                self.assertEqual(file.read(), (DEMO / "motion.csv").read_bytes())
            hyperex.write_frames(folder, self.performance, every=20)
            for frame in (0, 40, 80):
                name = f"frames/frame_{frame:04}.vtu"
                with open(f"{folder}/{name}", "rb") as file:
                    self.assertEqual(file.read(), (DEMO / name).read_bytes(), name)

    def test_tissue_set_and_set_back(self):
        before = self.simulator.options.tissue
        self.simulator.set_tissue(hyperex.Tissue(young_pa=50e3))
        softer = self.simulator.run()
        began = time.perf_counter()
        self.simulator.set_tissue(before)
        again = self.simulator.run()
        ms = 1e3 * (time.perf_counter() - began)
        print(f"set_tissue and run on the embedded face: {ms:.0f} ms")
        np.testing.assert_array_equal(again.skin_displacement_m,
                                      self.performance.skin_displacement_m)
        self.assertGreater(
            np.abs(softer.skin_displacement_m - self.performance.skin_displacement_m).max(), 1e-5)

    def test_one_value_a_tetrahedron_is_as_one_for_all(self):
        tets = len(mesh().tets)
        self.simulator.set_tissue(hyperex.Tissue(young_pa=np.full(tets, 192.4e3)))
        np.testing.assert_array_equal(self.simulator.run().skin_displacement_m,
                                      self.performance.skin_displacement_m)
        self.simulator.set_tissue(hyperex.Tissue())


class Arrays(unittest.TestCase):
    def setUp(self):
        self.performance = small_simulator().run()

    def test_shapes(self):
        run = self.performance
        frames, vertices = len(run.frame_time_s), len(run.skin_rest.points_m)
        self.assertEqual(run.skin_displacement_m.shape, (frames, vertices, 3))
        self.assertEqual(run.skin_displacement_m.dtype, np.float32)
        self.assertEqual(run.node_displacement_m.shape, (frames, len(run.nodes_m), 3))
        self.assertEqual(run.nodes_m.dtype, np.float64)
        self.assertEqual(run.tets.shape, (len(coarse_mesh().tets), 4))
        self.assertEqual(run.scan_vertices, len(face().mesh.points_m))

    def test_views_share_memory_and_keep_it(self):
        run = self.performance
        a, b = run.skin_displacement_at(5), run.skin_displacement_at(5)
        self.assertTrue(np.shares_memory(a, b))
        self.assertFalse(a.flags.writeable)
        self.assertIs(run.skin_displacement_m, run.skin_displacement_m)
        kept = a.copy()
        del run, b
        self.performance = None
        gc.collect()
        small_simulator().run()  # would take the memory if it were free
        np.testing.assert_array_equal(a, kept)

    def test_frames(self):
        run = self.performance
        np.testing.assert_array_equal(run.skin_displacement_at(-1), run.skin_displacement_m[-1])
        with self.assertRaises(IndexError):
            run.skin_displacement_at(len(run.frame_time_s))
        moved = run.skin_at(run.peak_frame).points_m
        np.testing.assert_array_equal(
            moved, run.skin_rest.points_m + run.skin_displacement_at(run.peak_frame).astype(float))


class Setters(unittest.TestCase):
    def test_each_has_an_effect_and_is_kept(self):
        simulator = small_simulator()
        base = simulator.run().skin_displacement_m
        support = hyperex.SupportOptions(skull="held", field_pa_per_m=0)
        drive = hyperex.DriveOptions(gain=0.5)
        for name, value in (("support", support), ("drive", drive),
                            ("tissue", hyperex.Tissue(young_pa=30e3))):
            with self.subTest(name):
                changed = copy.copy(simulator)
                getattr(changed, f"set_{name}")(value)
                self.assertEqual(getattr(changed.options, name), value)
                self.assertGreater(np.abs(changed.run().skin_displacement_m - base).max(), 1e-5)
        np.testing.assert_array_equal(simulator.run().skin_displacement_m, base)

    def test_motion(self):
        simulator = small_simulator()
        half = hyperex.prepare_motion(
            hyperex.embedded_mouth_opening(face().landmarks, peak_deg=6.5), face().landmarks)
        before = simulator.run().report.lip_gap_mm
        simulator.set_motion(half)
        after = simulator.run().report.lip_gap_mm
        self.assertLess(after, 0.7 * before)
        self.assertGreater(after, 0.3 * before)

    def test_all_points_are_those_that_skin_can_follow(self):
        opening = hyperex.embedded_mouth_opening(face().landmarks)
        names = [f"ibug68_{k}" for k in range(68)] + ["stomion"]
        rows = [opening.names.index(name) for name in names]
        skull = ["ibug68_27", "ibug68_28", "ibug68_36", "ibug68_45"]
        prepared = hyperex.prepare_motion(
            hyperex.Motion(names, opening.time_s, opening.positions_m[:, rows]), face().landmarks,
            rigid_points=skull)
        of_skin = [name for name in names[:-1] if name not in skull]
        runs = []
        for drive in (hyperex.DriveOptions(all_points=True), hyperex.DriveOptions(points=of_skin)):
            simulator = small_simulator(drive=drive)
            simulator.set_motion(prepared)
            runs.append(simulator.run().skin_displacement_m)
        np.testing.assert_array_equal(*runs)

    def test_out_of_range_changes_nothing(self):
        simulator = small_simulator()
        options = simulator.options
        options.time.step_s = 7
        with self.assertRaisesRegex(hyperex.InputError,
                                    r"time.step_s = 7: expected a number from 1e-06 to 0.1"):
            simulator.set_options(options)
        with self.assertRaisesRegex(
                hyperex.InputError, r"tissue.young_pa = -5: expected a number from 1 to 1e\+09 Pa"):
            simulator.set_tissue(hyperex.Tissue(young_pa=-5))
        with self.assertRaisesRegex(hyperex.InputError, "3 values: expected one for each"):
            simulator.set_tissue(hyperex.Tissue(young_pa=[1e5, 1e5, 1e5]))
        values = np.full(len(coarse_mesh().tets), 1e5)
        values[7] = -1
        with self.assertRaisesRegex(hyperex.InputError,
                                    "tissue.young_pa = -1: expected numbers from 1 to"):
            simulator.set_tissue(hyperex.Tissue(young_pa=values))
        self.assertEqual(simulator.options, hyperex.SimulationOptions())

    def test_input_errors_are_value_errors(self):
        simulator = small_simulator()
        simulator.set_drive(hyperex.DriveOptions(points=["no_such_point"]))
        with self.assertRaisesRegex(ValueError, "no_such_point"):
            simulator.run()


class Forces(unittest.TestCase):
    def test_other_muscles_answer_other_than_prescribed_points(self):
        simulator = small_simulator()
        simulator.set_drive(simulator.options.drive.replace(by="muscles"))
        base = simulator.run()
        self.assertLess(base.report.driven_off_mm, 0.5)
        self.assertEqual(small_simulator().run().muscles.names, [])
        simulator.hold_load()
        weak = hyperex.MuscleOptions(gains={"side_R": 0.0})
        simulator.set_options(simulator.options.replace(muscles=weak))
        self.assertEqual(simulator.options.muscles.gains, {"side_R": 0.0})
        peak = base.peak_frame
        change = simulator.run().skin_displacement_m[peak] - base.skin_displacement_m[peak]
        self.assertGreater(np.abs(change).max(), 1e-4)

    def test_which_activations_the_recording_determines(self):
        simulator = small_simulator()
        simulator.set_drive(simulator.options.drive.replace(by="muscles"))
        run = simulator.run()
        muscles = run.muscles
        shape = (len(muscles.names), len(muscles.time_s))
        for array in (muscles.activation, muscles.sigma, muscles.prior_sigma):
            self.assertEqual(array.shape, shape)
        self.assertTrue((muscles.sigma <= muscles.prior_sigma * (1 + 1e-9)).all())
        share = 1 - (muscles.sigma / muscles.prior_sigma) ** 2
        most = int(np.abs(muscles.activation).sum(axis=0).argmax())
        of_prior = [n for n, s in zip(muscles.names, share[:, most]) if s < 1 / 3]
        self.assertEqual(muscles.mostly_prior(most), of_prior)
        self.assertTrue(0 < len(of_prior) < shape[0], "the points see some muscles and not all")
        self.assertEqual(muscles.different_from_zero(most),
                         [n for n, a, s in zip(muscles.names, muscles.activation[:, most],
                                               muscles.sigma[:, most]) if abs(a) > 1.96 * s])
        self.assertEqual(muscles.mostly_prior(-1), muscles.mostly_prior(shape[1] - 1))
        with self.assertRaises(IndexError):
            muscles.mostly_prior(shape[1])

    def test_forces_found_anew_are_warned_of(self):
        simulator = small_simulator()
        simulator.set_drive(simulator.options.drive.replace(by="muscles"))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            simulator.run()
        simulator.set_tissue(hyperex.Tissue(young_pa=50e3))
        with self.assertWarnsRegex(UserWarning, r"call hold_load\(\) before") as warned:
            report = simulator.run().report
        self.assertEqual(warned.filename, __file__)
        self.assertTrue(report.forces_found_anew)
        self.assertTrue(any("hold_load()" in note for note in report.notes))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            simulator.set_tissue(hyperex.Tissue(young_pa=60e3))
            with self.assertRaisesRegex(UserWarning, "hold_load"):
                simulator.run()
            simulator.hold_load()
            simulator.set_tissue(hyperex.Tissue(young_pa=70e3))
            self.assertFalse(simulator.run().report.forces_found_anew)

    def test_a_gain_on_an_idle_muscle_is_warned_of(self):
        simulator = small_simulator()
        weak = hyperex.MuscleOptions(gains={"corrugator_L": 0.3})
        simulator.set_options(simulator.options.replace(
            drive=simulator.options.drive.replace(by="muscles"), muscles=weak))
        with self.assertWarnsRegex(UserWarning, "corrugator_L is active by at most"):
            simulator.run()

    def test_refused(self):
        simulator = small_simulator()
        weak = hyperex.MuscleOptions(gains={"side_R": 0.5})
        with self.assertRaisesRegex(ValueError, "drive.by"):
            simulator.set_options(simulator.options.replace(muscles=weak))


class Contact(unittest.TestCase):
    def test_lips(self):
        opening = hyperex.embedded_mouth_opening(face().landmarks, head_moves=False)
        shut = hyperex.Motion(opening.names, opening.time_s,
                              opening.positions_m[:1] + 0.6 * (opening.positions_m[:1] - opening.positions_m))
        simulator = small_simulator()  # pressed farther than they are shut
        simulator.set_motion(hyperex.prepare_motion(shut, face().landmarks))
        passing = simulator.run().report
        simulator.set_options(hyperex.SimulationOptions(contact=hyperex.ContactOptions(lips=True)))
        touching = simulator.run().report
        self.assertEqual(passing.contact_frames, 0)
        self.assertGreater(touching.contact_frames, 0)
        self.assertGreater(passing.lip_overlap_mm, 0.5)
        self.assertLess(touching.lip_overlap_mm, 0.05)

    def test_teeth(self):
        obstacles = hyperex.obstacles(mesh(), face().landmarks)
        self.assertEqual((obstacles.rows_of_teeth, obstacles.eyes), (2, 2))
        rest = face().landmarks
        lips = [f"ibug68_{k}" for k in range(48, 68)]
        names = sorted(rest)
        back = np.array([[0, 0, -0.006] if name in lips else [0, 0, 0] for name in names])
        at_rest = np.array([rest[name] for name in names])
        pressed = hyperex.Motion(names, [k / 30 for k in range(7)],
                                 [at_rest + k / 6 * back for k in range(7)])
        simulator = hyperex.Simulator(
            mesh(), rest, hyperex.prepare_motion(pressed, rest),
            hyperex.SimulationOptions(drive=hyperex.DriveOptions(points=lips)))
        simulator.set_obstacles(obstacles)
        free = simulator.run()
        self.assertEqual(free.report.contact_frames, 0)
        options = simulator.options
        options.contact = hyperex.ContactOptions(teeth=True)
        simulator.set_options(options)
        touching = simulator.run()
        self.assertGreater(touching.report.contact_frames, 0)
        self.assertLess(touching.report.in_teeth_mm, 0.1)
        self.assertGreater(
            np.abs(touching.skin_displacement_m - free.skin_displacement_m).max(), 1e-5)

    def test_refused(self):
        with self.assertRaisesRegex(hyperex.InputError, "contact.patch_pa_per_m|patch_pa_per_m"):
            small_simulator(contact=hyperex.ContactOptions(patch_pa_per_m=-1))


class Stream(unittest.TestCase):
    def test_skin_follows_samples(self):
        simulator = small_simulator()
        followed = motion().motion
        simulator.start_stream(1 / 30)
        for positions in followed.positions_m[:41]:
            skin_m = simulator.step(positions - followed.positions_m[0])
        run = simulator.run()
        self.assertEqual(skin_m.shape, run.skin_rest.points_m.shape)
        off_m = np.linalg.norm(skin_m - run.skin_displacement_at(40), axis=1).max()
        self.assertLess(off_m, 0.1 * np.linalg.norm(skin_m, axis=1).max())

    def test_a_scene_with_variants_of_muscles(self):
        simulator = hyperex.Scene(SOURCE / "examples" / "demo.toml",
                                  {"mesh.element_size_mm": 10, "mesh.layers": 1}).simulator()
        with self.assertRaises(hyperex.InputError):
            simulator.start_stream(1 / 30)
        options = simulator.options
        options.drive.by = "displacement"
        simulator.set_options(options)
        simulator.start_stream(1 / 30)
        followed = simulator.motion.motion
        opened_m = followed.positions_m[20] - simulator.motion.rest_m
        self.assertEqual(opened_m.shape, (len(followed.names), 3))
        self.assertGreater(np.abs(simulator.step(opened_m)).max(), 1e-3)

    def test_refused(self):
        simulator = small_simulator()
        with self.assertRaisesRegex(RuntimeError, "before start_stream"):
            simulator.step(np.zeros((92, 3)))
        with self.assertRaisesRegex(hyperex.InputError, "interval_s = 0"):
            simulator.start_stream(0)
        with self.assertWarnsRegex(UserWarning, "33 ms are 0.033 s"):
            simulator.start_stream(33)
        simulator.start_stream(1 / 30)
        with self.assertRaisesRegex(hyperex.InputError, "places: expected displacements"):
            simulator.step(motion().rest_m)
        with self.assertRaisesRegex(hyperex.InputError, "3 rows: expected 92 points"):
            simulator.step(np.zeros((3, 3)))
        for shape in ((3, 92), (276,), (92, 2)):
            with self.assertRaisesRegex(ValueError, rf"displacement_m = an array of shape {re.escape(str(shape))}: "
                                                    r"expected \(92, 3\)"):
                simulator.step(np.zeros(shape))
        unmeasured = np.zeros((92, 3))
        unmeasured[11] = np.nan
        with self.assertRaisesRegex(hyperex.InputError, "point 12 of 92 is not finite"):
            simulator.step(unmeasured)

    def test_millimetres_are_refused(self):
        simulator = small_simulator()
        followed = motion().motion
        simulator.start_stream(1 / 30)
        opened_m = followed.positions_m[40] - followed.positions_m[0]
        with self.assertRaisesRegex(hyperex.InputError,
                                    r"point \w+ is displaced by .*; displacements are in metres"):
            simulator.step(1e3 * opened_m)
        self.assertGreater(np.abs(simulator.step(opened_m)).max(), 1e-3)


class Threads(unittest.TestCase):
    def test_copies_run_side_by_side(self):
        simulator = small_simulator()
        alone = simulator.run().skin_displacement_m
        runs = {}

        def run(key, copied):
            runs[key] = copied.run().skin_displacement_m
        threads = [threading.Thread(target=run, args=(k, copy.copy(simulator))) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(runs[0], alone)
        np.testing.assert_array_equal(runs[1], alone)

    def test_other_threads_go_on_and_may_not_use_it(self):
        simulator = small_simulator(solver=hyperex.SolverOptions(method="direct"))
        said = []
        started = threading.Event()

        def meddle():
            started.wait()
            try:
                simulator.set_tissue(hyperex.Tissue(young_pa=30e3))
            except RuntimeError as error:
                said.append(str(error))
        thread = threading.Thread(target=meddle)
        thread.start()

        def progress(share):
            started.set()
            while thread.is_alive():  # lets the other thread take the lock of Python
                time.sleep(0.001)
        simulator.run(progress)
        thread.join()
        self.assertEqual(len(said), 1)
        self.assertIn("this simulator is running", said[0])


if __name__ == "__main__":
    unittest.main()
