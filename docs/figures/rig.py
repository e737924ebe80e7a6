# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of rig.md: eight expressions of a rig, rendered by Blender side by side.

    hyperex sample out/sample
    hyperex rig out/sample/second_face.ply --landmarks out/sample/second_face_landmarks.json --out out/second_rig.glb
    blender --background --python-exit-code 1 --python docs/figures/rig.py -- out/second_rig.glb docs/images/rig.webp

Needs Debian's blender."""
import sys

import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that newer NumPy has dropped

import bpy  # noqa: E402
import mathutils  # noqa: E402

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


def light(name, place, at, watts, metres):
    lamp = bpy.data.lights.new(name, "AREA")
    lamp.energy, lamp.size = watts, metres
    thing = bpy.data.objects.new(name, lamp)
    thing.location = at + mathutils.Vector(place)
    thing.rotation_euler = (at - thing.location).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)


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
    eyes = [bpy.data.objects[name].matrix_world.translation for name in ("eye_R", "eye_L")]
    at = (eyes[0] + eyes[1]) / 2 + mathutils.Vector((0, 0, -0.042))
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 105
    camera.location = at + mathutils.Vector((0.16, -0.62, 0.02))  # from the face's left, as far as a portrait is taken
    camera.rotation_euler = (at - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    light("key", (0.45, -0.65, 0.3), at, 8, 0.35)
    light("fill", (-0.6, -0.5, 0.05), at, 3, 0.6)
    light("rim", (-0.3, 0.6, 0.4), at, 5, 0.3)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.62, 0.64, 0.66, 1)
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.6
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 96
    scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
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
