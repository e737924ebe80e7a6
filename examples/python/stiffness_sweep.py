# SPDX-License-Identifier: GPL-3.0-or-later
"""One simulator, seven stiffnesses: how far do the cheeks follow an opening mouth?

    python3 stiffness_sweep.py sweep.png
"""
import sys

import matplotlib
import numpy as np

import hyperex

matplotlib.use("Agg")  # writes files, needs no display
from matplotlib import pyplot  # noqa: E402

face = hyperex.embedded_face()
mesh = hyperex.build_tissue_mesh(face)
motion = hyperex.prepare_motion(hyperex.embedded_mouth_opening(face.landmarks), face.landmarks)
simulator = hyperex.Simulator(mesh, face.landmarks, motion)

young_kpa = np.geomspace(20, 500, 7)
excursion_mm = []
for young in young_kpa:
    simulator.set_tissue(hyperex.Tissue(young_pa=1e3 * young))  # what else was found is kept
    landmarks = simulator.run().landmarks
    excursion_mm.append([hyperex.distance_from_rest_mm(landmarks, [name]).max()
                         for name in ("cheek_L", "cheek_R")])
    print(f"{young:6.1f} kPa: left {excursion_mm[-1][0]:.3f} mm, right {excursion_mm[-1][1]:.3f} mm")

pyplot.semilogx(young_kpa, excursion_mm, "o-", label=["left", "right"])
pyplot.xlabel("Young's modulus (kPa)")
pyplot.ylabel("excursion of the cheek (mm)")
pyplot.legend()
pyplot.savefig(sys.argv[1] if len(sys.argv) > 1 else "sweep.png")
