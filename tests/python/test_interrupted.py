# SPDX-License-Identifier: GPL-3.0-or-later
import os
import signal
import threading
import unittest

import numpy as np

import hyperex
from support import small_simulator


class Interrupted(unittest.TestCase):
    def setUp(self):
        self.simulator = small_simulator(solver=hyperex.SolverOptions(method="direct"),
                                         time=hyperex.TimeOptions(step_s=1e-4))
        self.shares = []

    def usable_afterwards(self):
        self.simulator.set_options(hyperex.SimulationOptions())
        np.testing.assert_array_equal(self.simulator.run().skin_displacement_m,
                                      small_simulator().run().skin_displacement_m)

    def test_ctrl_c(self):
        stepping = threading.Event()

        def press():
            stepping.wait()
            os.kill(os.getpid(), signal.SIGINT)
        thread = threading.Thread(target=press)
        thread.start()

        def progress(share):
            stepping.set()
            self.shares.append(share)
        with self.assertRaises(KeyboardInterrupt):
            self.simulator.run(progress)
        thread.join()
        self.assertLess(self.shares[-1], 0.9)  # not after the run was done
        self.usable_afterwards()

    def test_cancelled(self):
        with self.assertRaises(hyperex.Cancelled):
            self.simulator.run(self.shares.append, cancelled=lambda: len(self.shares) > 0)
        self.assertLess(self.shares[-1], 0.9)
        self.usable_afterwards()

    def test_what_callbacks_raise_comes_out(self):
        def progress(share):
            self.shares.append(share)
            raise ZeroDivisionError("of the callback")
        with self.assertRaisesRegex(ZeroDivisionError, "of the callback"):
            self.simulator.run(progress)
        self.assertEqual(len(self.shares), 1)
        with self.assertRaises(TypeError):
            self.simulator.run(cancelled=lambda too_many: False)
        self.usable_afterwards()

    def test_progress_rises_to_one(self):
        self.simulator.set_options(hyperex.SimulationOptions(
            solver=hyperex.SolverOptions(method="direct")))
        self.simulator.run(self.shares.append)
        self.assertEqual(self.shares, sorted(self.shares))
        self.assertEqual(self.shares[-1], 1)
        self.assertGreater(len(self.shares), 10)


if __name__ == "__main__":
    unittest.main()
