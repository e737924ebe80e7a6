# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays a recording of ARKit's weights on a rig of `hyperex rig`, in Blender:

    blender --background --python examples/blender/play_weights.py -- RIG.glb WEIGHTS.csv OUT.blend

OUT may also be .fbx or .glb: the animated face as Blender exports it, for Unreal, Unity, Maya and others.

WEIGHTS.csv has a column time_s, time or timestamp (seconds), or Timecode as Live Link Face writes it, and columns named
after blend shapes. Each mesh of the rig takes the shapes that it has: the skin all of them, the eyes those of gaze, the
lower teeth those of the jaw.

A corrective, as jawOpen_mouthClose, has the product of the values of its two shapes. In a .blend drivers compute it, so
that it also follows values that are changed by hand. Other files know no drivers, and it gets a key at every frame.
"""
import csv
import math
import os
import sys

import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that newer NumPy has dropped

import bpy  # noqa: E402

FRAME_RATE = 60


def seconds(row):
    """Time of a row; a timecode is HH:MM:SS:FF.fff at 60 frames a second."""
    for name in ("time_s", "time", "timestamp"):
        if row.get(name):
            return float(row[name])
    hours, minutes, whole, frames = row["Timecode"].split(":")
    return 3600 * int(hours) + 60 * int(minutes) + int(whole) + float(frames) / FRAME_RATE


def read_weights(file):
    """Times in seconds from the first row, and for each column its values; empty cells repeat the last value."""
    with open(file, newline="", encoding="utf-8-sig") as stream:
        rows = list(csv.DictReader(stream))
    if not rows or not {"time_s", "time", "timestamp", "Timecode"} & set(rows[0]):
        sys.exit(f"{file}: expected rows, and a column time_s, time, timestamp or Timecode")
    first = seconds(rows[0])
    times = [seconds(row) - first for row in rows]
    weights = {}
    for name in rows[0]:
        values, last = [], 0.0
        for row in rows:
            try:
                last = float(row[name])
            except (TypeError, ValueError):
                pass
            values.append(last)
        weights[name.lower()] = values
    return times, weights


def corrected(name, shapes):
    """The names of the two shapes whose combination a corrective corrects; None where the name is none of two.

    A shape's own name may have an underscore, as mouthSmile_L.
    """
    parts = name.split("_")
    for at in range(1, len(parts)):
        first, second = "_".join(parts[:at]), "_".join(parts[at:])
        if first in shapes and second in shapes and first != second:
            return first, second
    return None


def key_shape(mesh, name, times, values):
    curve = mesh.shape_keys.animation_data_create()
    curve.action = curve.action or bpy.data.actions.new(f"{mesh.name} weights")
    points = curve.action.fcurves.new(f'key_blocks["{name}"].value').keyframe_points
    points.add(len(times))
    for point, time, value in zip(points, times, values):
        point.co = (1 + time * FRAME_RATE, value)
        point.interpolation = "LINEAR"


def key_shapes(mesh, skin, times, weights):
    """Animates the shapes that both have, but for correctives; how many. `skin`: shape keys of all shapes."""
    animated = 0
    for key in mesh.shape_keys.key_blocks:
        values = weights.get(key.name.lower())  # jawOpen, JawOpen
        if values is None or not any(values) or corrected(key.name, skin.key_blocks):
            continue
        key_shape(mesh, key.name, times, values)
        animated += 1
    return animated


def product(times, first, second):
    """Times and values of the product of two weights: at the rows, and at each whole frame between them.

    Weights run straight from row to row. Their product does not.
    """
    at, values = [], []
    for row, time in enumerate(times):
        if row > 0:
            begin = times[row - 1]
            after, before = begin * FRAME_RATE + 1e-6, time * FRAME_RATE - 1e-6
            for frame in range(math.floor(after) + 1, math.ceil(before)):
                share = (frame / FRAME_RATE - begin) / (time - begin)
                a, b = (of[row - 1] + share * (of[row] - of[row - 1]) for of in (first, second))
                at.append(frame / FRAME_RATE)
                values.append(a * b)
        at.append(time)
        values.append(first[row] * second[row])
    return at, values


def key_correctives(mesh, skin, times, weights):
    """Animates the correctives by the products of two weights; how many of them move."""
    animated = 0
    for key in mesh.shape_keys.key_blocks:
        pair = corrected(key.name, skin.key_blocks)
        both = [weights.get(name.lower()) for name in pair or ()]
        if not pair or None in both:
            continue
        at, values = product(times, *both)
        if any(values):
            key_shape(mesh, key.name, at, values)
            animated += 1
    return animated


def drive_correctives(mesh, skin):
    """Lets a driver give each corrective the product of the skin's two values; how many."""
    driven = 0
    for key in mesh.shape_keys.key_blocks:
        pair = corrected(key.name, skin.key_blocks)
        if not pair:
            continue
        driver = key.driver_add("value").driver
        driver.type = "SCRIPTED"
        for letter, name in zip("ab", pair):
            variable = driver.variables.new()
            variable.name = letter
            variable.targets[0].id_type = "KEY"
            variable.targets[0].id = skin
            variable.targets[0].data_path = f'key_blocks["{name}"].value'
        driver.expression = "a * b"
        driven += 1
    return driven


def save(out):
    kind = os.path.splitext(out)[1].lower()
    if kind == ".blend":
        bpy.ops.wm.save_as_mainfile(filepath=out)
    elif kind == ".fbx":
        # One animation of the whole scene: when it exports each action, the exporter omits shape keys.
        bpy.ops.export_scene.fbx(
            filepath=out, path_mode="COPY", embed_textures=True, bake_anim_use_all_actions=False,
            bake_anim_use_nla_strips=False)
    elif kind == ".glb":
        bpy.ops.export_scene.gltf(filepath=out)
    else:
        sys.exit(f"{out}: expected .blend, .fbx or .glb")


def main(rig, recording, out):
    if not os.path.isfile(rig):
        sys.exit(f"{rig}: no such file")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=rig)
    times, weights = read_weights(recording)
    scene = bpy.context.scene
    scene.render.fps = FRAME_RATE
    scene.frame_start, scene.frame_end = 1, 1 + round(times[-1] * FRAME_RATE)
    moving = 0
    meshes = [item for item in bpy.data.objects if item.type == "MESH" and item.data.shape_keys]
    skin = max((item.data.shape_keys for item in meshes), key=lambda keys: len(keys.key_blocks), default=None)
    for item in meshes:
        animated = key_shapes(item.data, skin, times, weights)
        moving += animated
        print(f"{item.name}: {animated} shapes move")
        if out.lower().endswith(".blend"):
            correctives = drive_correctives(item.data, skin)
        else:
            correctives = key_correctives(item.data, skin, times, weights)
        if correctives:
            print(f"{item.name}: {correctives} correctives follow")
    if moving == 0:
        sys.exit(f"{recording}: no column is named after a shape of {rig} with a weight other than 0")
    save(os.path.abspath(out))
    print(f"{len(times)} samples over {times[-1]:.1f} s, written to {out}")


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if len(given) != 3:
        sys.exit("expected after --: RIG.glb WEIGHTS.csv OUT.blend")
    main(*given)
