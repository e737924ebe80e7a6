# SPDX-License-Identifier: GPL-3.0-or-later
"""How far is a simulated face from a second scan of the same person, mouth open?

    python3 second_scan.py [neutral.ply neutral_landmarks.json motion.csv open.ply]

Without files a stiffer run of the embedded face stands for the second scan.
"""
import sys

import numpy as np

import hyperex

own = len(sys.argv) == 5
face = hyperex.read_face(*sys.argv[1:3]) if own else hyperex.embedded_face()
recorded = (hyperex.read_motion(sys.argv[3]) if own
            else hyperex.embedded_mouth_opening(face.landmarks))
simulator = hyperex.Simulator(hyperex.build_tissue_mesh(face), face.landmarks,
                              hyperex.prepare_motion(recorded, face.landmarks))
performance = simulator.run()
simulated = performance.skin_at(performance.peak_frame)

if own:
    scanned = hyperex.read_scan(sys.argv[4]).mesh  # in the axes of the neutral scan
else:
    simulator.set_tissue(hyperex.Tissue(young_pa=1e6))
    scanned = simulator.run().skin_at(performance.peak_frame)

still_m = hyperex.distance_to_surface(performance.skin_rest.points_m, scanned)
distance_m = hyperex.distance_to_surface(simulated.points_m, scanned)
regions = hyperex.regions_of(performance.skin_rest.points_m, face.landmarks)
print("region      mean (mm)  standing still (mm)")
for name, vertices in {"surface": np.arange(len(distance_m)), **regions}.items():
    print(f"{name:<10} {hyperex.statistics_of(distance_m, vertices).mean_mm:10.3f} "
          f"{hyperex.statistics_of(still_m, vertices).mean_mm:20.3f}")
