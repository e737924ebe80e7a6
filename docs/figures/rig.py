# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of rig.md: eight expressions of a rig, rendered by Blender side by side.

    hyperex sample out/sample
    hyperex rig out/sample/second_face.ply --landmarks out/sample/second_face_landmarks.json --out out/second_rig.glb
    blender --background --python-exit-code 1 --python docs/figures/rig.py -- out/second_rig.glb docs/images/rig.webp

Needs Debian's blender."""
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples/blender"))
import play_weights  # noqa: E402  Importing it also repairs the glTF importer.
import bpy  # noqa: E402

WIDTH, HEIGHT, COLUMNS = 300, 358, 4
EXPRESSIONS = (
    {},
    {"mouthSmileLeft": 0.9, "mouthSmileRight": 0.9, "cheekSquintLeft": 0.6, "cheekSquintRight": 0.6},
    {"jawOpen": 0.7},
    {"mouthPucker": 0.9},
    {"eyeBlinkLeft": 1, "eyeBlinkRight": 1},
    {"browInnerUp": 0.8, "browOuterUpLeft": 0.8, "browOuterUpRight": 0.8, "jawOpen": 0.3, "eyeWideLeft": 0.5, "eyeWideRight": 0.5},
    {"mouthSmileLeft": 0.9},
    {"mouthFrownLeft": 0.9, "mouthFrownRight": 0.9, "browDownLeft": 0.8, "browDownRight": 0.8},
)


def show(weights):
    for thing in bpy.data.objects:
        if thing.type == "MESH" and thing.data.shape_keys:
            for key in thing.data.shape_keys.key_blocks:
                key.value = weights.get(key.name, 0)


def picture(scene, weights):
    """RGBA rows from the bottom."""
    show(weights)
    scene.render.filepath = bpy.app.tempdir + "rig.png"
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = numpy.array(image.pixels[:], dtype=numpy.float32).reshape(HEIGHT, WIDTH, 4)
    bpy.data.images.remove(image)
    return pixels


def main(rig, out):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=rig)
    scene = bpy.context.scene
    play_weights.film(scene)
    scene.cycles.samples = 96
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    rows = len(EXPRESSIONS) // COLUMNS
    sheet = numpy.ones((rows * HEIGHT, COLUMNS * WIDTH, 4), numpy.float32)
    for k, weights in enumerate(EXPRESSIONS):
        row, column = rows - 1 - k // COLUMNS, k % COLUMNS
        sheet[row * HEIGHT:(row + 1) * HEIGHT, column * WIDTH:(column + 1) * WIDTH] = picture(scene, weights)
    image = bpy.data.images.new("sheet", COLUMNS * WIDTH, rows * HEIGHT)
    image.pixels = sheet.ravel()
    image.file_format = "WEBP"
    image.filepath_raw = out
    image.save()


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1:])
