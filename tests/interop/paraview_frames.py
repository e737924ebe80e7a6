# SPDX-License-Identifier: GPL-3.0-or-later
# Opens the frames of a run in ParaView: pvpython paraview_frames.py RUN_FOLDER
import json
import os
import sys

import paraview
from paraview.simple import CellSize, PVDReader, UpdatePipeline, WarpByVector


def check(holds, what):
    if not holds:
        print(f'paraview: FAILED: {what}')
        sys.stdout.flush()
        os._exit(1)


def array(attributes, name):
    found = [a for a in attributes if a.Name == name]
    check(len(found) == 1, f'there is an array "{name}"')
    return found[0]


run = sys.argv[1]
with open(os.path.join(run, 'summary.json')) as file:
    summary = json.load(file)
reader = PVDReader(FileName=os.path.join(run, 'frames.pvd'))
reader.UpdatePipelineInformation()
times = list(reader.TimestepValues)
expected = (summary['frames'] - 1) // summary['options']['output']['vtu_every'] + 1
check(len(times) == expected, f'{expected} time steps; found {len(times)}')
check(times[0] == 0 and times == sorted(times), 'times rise from 0')

for time in times:
    UpdatePipeline(time, reader)
    info = reader.GetDataInformation()
    check(info.GetNumberOfPoints() == summary['nodes'], f'points at {time} s')
    check(info.GetNumberOfCells() == summary['tets'], f'cells at {time} s')
    moved = array(reader.PointData, 'displacement (m)')
    check(moved.GetNumberOfComponents() == 3, 'displacement has three components')
    low, high = moved.GetRange(-1)  # of the length
    check(0 <= low <= high < 0.1, f'displacement at {time} s: {low} to {high} m')
    strain = array(reader.CellData, 'strain (1)')
    names = [strain.GetComponentName(k) for k in range(strain.GetNumberOfComponents())]
    check(names == ['XX', 'YY', 'ZZ', 'XY', 'YZ', 'XZ'], f'components of strain: {names}')
    inverted = array(reader.CellData, 'inverted').GetRange(0)
    check(inverted[0] == 0 and inverted[1] in (0, 1), f'inverted at {time} s: {inverted}')
    array(reader.CellData, 'von Mises stress (kPa)')

peak = min(times, key=lambda t: abs(t - summary['peak_time_s']))
UpdatePipeline(peak, reader)
stress = array(reader.CellData, 'von Mises stress (kPa)').GetRange(0)[1]
stated = summary['at_peak']['von_mises_stress_kpa']['max']
check(abs(stress - stated) < 1e-4 * stated, f'greatest stress {stress}; summary: {stated}')
farthest = array(reader.PointData, 'displacement (m)').GetRange(-1)[1]
check(farthest > 0.002, f'the tissue moves at the peak: {farthest} m')

warp = WarpByVector(Input=reader, Vectors=['POINTS', 'displacement (m)'])
sizes = CellSize(Input=warp, ComputeVolume=1)
UpdatePipeline(peak, sizes)
turned = array(sizes.CellData, 'Volume').GetRange(0)[0] <= 0
check(turned == (summary['at_peak']['inverted_tets'] > 0), 'marked elements are those turned inside out')
print(f'paraview {paraview.__version__}: {len(times)} time steps of {summary["nodes"]} points, {summary["tets"]} cells; '
      f'stress to {stress:.1f} kPa, displacement to {1e3 * farthest:.1f} mm')
