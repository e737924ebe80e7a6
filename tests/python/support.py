# SPDX-License-Identifier: GPL-3.0-or-later
"""What several tests begin with."""
import functools
import os
import pathlib

import hyperex

SOURCE = pathlib.Path(os.environ["HYPEREX_SOURCE"])
DEMO = pathlib.Path(os.environ["HYPEREX_DEMO"])  # what the golden run of examples/mouth_open.toml wrote


@functools.cache
def face():
    return hyperex.embedded_face()


@functools.cache
def motion():
    return hyperex.prepare_motion(hyperex.embedded_mouth_opening(face().landmarks),
                                  face().landmarks)


@functools.cache
def mesh():
    return hyperex.build_tissue_mesh(face())


@functools.cache
def coarse_mesh():
    return hyperex.build_tissue_mesh(
        face(), hyperex.TissueMeshOptions(element_size_m=0.01, layers=1))


def small_simulator(**options):
    """Quick to solve: large elements."""
    return hyperex.Simulator(coarse_mesh(), face().landmarks, motion(),
                             hyperex.SimulationOptions(**options))
