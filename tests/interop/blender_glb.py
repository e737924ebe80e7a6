# SPDX-License-Identifier: GPL-3.0-or-later
# Imports performance.glb of a run: blender -b --factory-startup --python blender_glb.py -- RUN_FOLDER
# The frame at the peak must be skin_peak.ply.
import json
import os
import re
import sys

import numpy

numpy.bool = bool  # the importer of Blender 3.4 uses the name, which numpy 1.24 has dropped

import bpy  # noqa: E402


def check(holds, what):
    if not holds:
        print(f'blender: FAILED: {what}')
        sys.stdout.flush()
        os._exit(1)


def ply_points_mm(path):
    """The vertices of a binary PLY."""
    with open(path, 'rb') as file:
        data = file.read()
    head, body = data.split(b'end_header\n', 1)
    vertex = head.decode().split('element vertex ')[1]
    count = int(vertex.split('\n', 1)[0])
    kinds = {'float': '<f4', 'double': '<f8', 'uchar': 'u1', 'int': '<i4'}
    properties = re.findall(r'^property (\w+) (\w+)$', vertex.split('element face')[0], re.M)
    rows = numpy.frombuffer(body, [(name, kinds[kind]) for kind, name in properties], count)
    return numpy.stack([rows['x'], rows['y'], rows['z']], 1).astype(float)


def import_and_check(run, glb, summary):
    rate = round(summary['options']['time']['frame_rate_hz'])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = rate  # before importing: keys then fall on frames
    bpy.ops.import_scene.gltf(filepath=os.path.join(run, 'performance.glb'))
    meshes = [o for o in bpy.data.objects if o.type == 'MESH']
    names = sorted(o.name for o in meshes)
    eyes = ['eye_L', 'eye_R'] if 'eye_L' in names else []
    check(names in (eyes + ['face'], eyes + ['face', 'lower_teeth', 'upper_teeth']),
          f'a face, its eyes and its teeth; found {names}')
    face = bpy.data.objects['face']
    check(face.data.name == 'skin', f'the mesh of the face is called {face.data.name}')

    keys = face.data.shape_keys.key_blocks
    poses = [k for k in keys if k.name != 'Basis']
    check(len(poses) == glb['keys'], f'{glb["keys"]} shape keys; found {len(poses)}')
    for key in poses:
        check(re.fullmatch(r'pose_\d+\.\d+s', key.name), f'name of key {key.name}')
        check(key.slider_min == 0 and key.slider_max == 1, f'slider of {key.name}')
    action = face.data.shape_keys.animation_data.action
    check(action is not None, 'the keys are animated')
    first, last = action.frame_range
    check(abs(first) < 1e-3 and abs(last - (summary['frames'] - 1)) < 1e-2,
          f'clip from frame {first} to {last}')
    values = [p.co[1] for c in action.fcurves for p in c.keyframe_points]
    check(min(values) >= 0 and max(values) <= 1, f'weights from {min(values)} to {max(values)}')
    check(max(abs(p.co[0] - round(p.co[0])) for c in action.fcurves
              for p in c.keyframe_points) < 1e-2, 'keys fall on frames')

    scene.frame_set(round(rate * summary['peak_time_s']))
    shown = face.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    points = numpy.array([shown.matrix_world @ v.co for v in mesh.vertices])
    check(len(points) == summary['skin_vertices'], f'{len(points)} vertices')
    glTF = numpy.stack([points[:, 0], points[:, 2], -points[:, 1]], 1)  # z up -> y up
    truth = ply_points_mm(os.path.join(run, 'skin_peak.ply'))
    check(truth[:, 1].max() - truth[:, 1].min() > 100, 'y is up, and the scale is millimetres')
    off = numpy.linalg.norm(1e3 * glTF - truth, axis=1).max()
    check(off <= glb['largest_error_mm'] + 0.01, f'the peak is {off:.3f} mm off')
    print(f'blender: {run}: {len(poses)} poses, frames {first:.0f} to {last:.0f}, '
          f'{len(points)} vertices, {off:.3f} mm off at the peak')


run = sys.argv[sys.argv.index('--') + 1]
with open(os.path.join(run, 'summary.json')) as file:
    summary = json.load(file)
print(f'blender: version {bpy.app.version_string}')
try:
    import_and_check(run, summary['glb'], summary)
    for variant in summary.get('variants', {}).get('table', [])[1:]:
        import_and_check(os.path.join(run, 'variants', variant['name']), variant['glb'], summary)
except Exception as problem:  # Blender would end with status 0
    check(False, repr(problem))
