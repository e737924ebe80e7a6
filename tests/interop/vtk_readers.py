# SPDX-License-Identifier: GPL-3.0-or-later
# Reads what a run wrote by VTK's own readers, without ParaView: pvpython vtk_readers.py RUN_FOLDER
import glob
import json
import os
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOGeometry import vtkGLTFReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def check(holds, what):
    if not holds:
        print(f'vtk: FAILED: {what}')
        sys.stdout.flush()
        os._exit(1)


def read(reader, name):
    reader.SetFileName(os.path.join(run, name))
    reader.Update()
    return reader.GetOutput()


run = sys.argv[1]
with open(os.path.join(run, 'summary.json')) as file:
    summary = json.load(file)

skin = read(vtkPLYReader(), 'skin_peak.ply')
check(skin.GetNumberOfPoints() == summary['skin_vertices'],
      f'{skin.GetNumberOfPoints()} points of skin_peak.ply; summary: {summary["skin_vertices"]}')

scene = vtkGLTFReader()
model = read(scene, 'performance.glb')
points = triangles = 0
leaves = model.NewIterator()
while not leaves.IsDoneWithTraversal():
    points += leaves.GetCurrentDataObject().GetNumberOfPoints()
    triangles += leaves.GetCurrentDataObject().GetNumberOfCells()
    leaves.GoToNextItem()
check(points >= summary['skin_vertices'], f'{points} points of performance.glb')
check(triangles > 800, f'{triangles} triangles of performance.glb')
scene.UpdateInformation()
check(scene.GetNumberOfAnimations() == 1, f'{scene.GetNumberOfAnimations()} animations')

frames = sorted(glob.glob(os.path.join(run, 'frames', '*.vtu')))
for frame in frames[:1] + frames[-1:]:
    grid = read(vtkXMLUnstructuredGridReader(), frame)
    check(grid.GetNumberOfPoints() == summary['nodes'], f'points of {frame}')
    check(grid.GetNumberOfCells() == summary['tets'], f'cells of {frame}')
    moved = grid.GetPointData().GetArray('displacement (m)')
    check(moved is not None, f'displacement of {frame}')
    check(abs(vtk_to_numpy(moved)).max() < 0.1, f'metres in {frame}')
print(f'vtk {vtkVersion.GetVTKVersion()}: {points} points and {triangles} triangles of a moving model, '
      f'{len(frames)} frames of tissue')
