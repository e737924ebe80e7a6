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
        for k in range(40):
            cycle(k)
        gc.collect()
        before = resident_mb()
        for k in range(200):
            cycle(k)
        gc.collect()
        grown = resident_mb() - before
        print(f"resident memory {before:.1f} MB, grown by {grown:.2f} MB over 200 runs")
        self.assertLess(grown, 5)


if __name__ == "__main__":
    unittest.main()
