# SPDX-License-Identifier: GPL-3.0-or-later
import gc
import os
import unittest

import hyperex
from support import small_simulator


def resident_mb():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


class Memory(unittest.TestCase):
    def test_no_leak_over_200_runs(self):
        simulator = small_simulator()

        def cycle(k):
            simulator.set_tissue(hyperex.Tissue(young_pa=1e5 + 1e3 * (k % 7)))
            run = simulator.run()
            run.skin_displacement_m, run.node_displacement_m, run.landmarks["cheilion_L"]
        def growth_mb(runs):
            before = resident_mb()
            for k in range(runs):
                cycle(k)
            gc.collect()
            return resident_mb() - before
        growth_mb(40)
        # What the allocator takes once for a thread is no leak: a leak is as large in either half.
        halves = [growth_mb(100), growth_mb(100)]
        print(f"resident memory {resident_mb():.1f} MB, grown by {halves} MB over 2 x 100 runs")
        self.assertLess(min(halves), 2.5)


if __name__ == "__main__":
    unittest.main()
