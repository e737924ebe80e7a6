# SPDX-License-Identifier: GPL-3.0-or-later
"""The face that comes with Hyperex opens its mouth: how far do its corners travel?

    python3 first_steps.py [face.glb]
"""
import sys

import numpy as np

import hyperex

face = hyperex.embedded_face()  # of your own: hyperex.read_face("me.ply", "me_landmarks.json")
mesh = hyperex.build_tissue_mesh(face)

# For a recording of your own: hyperex.read_motion("me.csv"). The head's own motion is removed; the
# rest is carried to this face.
recorded = hyperex.embedded_mouth_opening(face.landmarks)
motion = hyperex.prepare_motion(recorded, face.landmarks)

simulator = hyperex.Simulator(mesh, face.landmarks, motion)
performance = simulator.run()
print(performance.report)

moved_m = np.linalg.norm(performance.skin_displacement_m, axis=2)  # frames x vertices
frame, vertex = np.unravel_index(moved_m.argmax(), moved_m.shape)
print(f"vertex {vertex} moves most: {1e3 * moved_m[frame, vertex]:.1f} mm "
      f"at {performance.frame_time_s[frame]:.2f} s")

corners = hyperex.excursions_of(performance.landmarks)["cheilion"]
print(f"excursion of the corners of the mouth: left {corners.left.excursion_mm:.2f} mm, "
      f"right {corners.right.excursion_mm:.2f} mm")

if len(sys.argv) > 1:  # for Blender or a browser
    hyperex.write_glb(sys.argv[1], performance, face.scan)
