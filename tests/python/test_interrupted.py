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

    def is_running(self):
        try:
            self.simulator.set_tissue(self.tissue)
        except RuntimeError:
            return True
        return False

    def test_ctrl_c(self):
        self.tissue = self.simulator.options.tissue
        running = []

        def press():
            while not self.is_running():
                pass
            os.kill(os.getpid(), signal.SIGINT)

        def pressed(*_):  # after the run, if the run did not ask for signals
            running.append(self.is_running())
            raise KeyboardInterrupt
        before = signal.signal(signal.SIGINT, pressed)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        thread = threading.Thread(target=press)
        with self.assertRaises(KeyboardInterrupt):
            thread.start()
            while not running:  # again where the other thread held it just then
                try:
                    self.simulator.run()
                except RuntimeError:
                    pass
        thread.join()
        self.assertEqual(running, [True])
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
