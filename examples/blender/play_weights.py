# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays a recording of ARKit's weights on a rig of `hyperex rig`, in Blender:

    blender --background --python examples/blender/play_weights.py -- RIG.glb WEIGHTS.csv OUT.blend

OUT may also be .fbx or .glb: the animated face as Blender exports it, for Unreal, Unity, Maya and others. The materials of
an FBX do not read the colours of vertices, so they are baked into textures first. With .png the frame in which the face
moves most is rendered, with .mp4 the whole recording, 30 frames a second.

Installed as an add-on (Edit, Preferences, Add-ons, Install), it adds two entries to File, Import: a rig, and weights for it.

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
import mathutils  # noqa: E402

bl_info = {
    "name": "Hyperex rig and weights",
    "author": "The Hyperex authors",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "File > Import",
    "description": "Imports a rig of hyperex rig, and plays a CSV of ARKit's weights on it",
    "category": "Import-Export",
}

FRAME_RATE = 60
FILM_FRAME_RATE = 30
TEXTURE_PIXELS, SKIN_TEXTURE_PIXELS = 1024, 2048


class InputError(Exception):
    """A file that cannot be used, and why."""


def seconds(row):
    """Time of a row; a timecode is HH:MM:SS:FF.fff at 60 frames a second."""
    for name in ("time_s", "time", "timestamp"):
        if row.get(name):
            return float(row[name])
    hours, minutes, whole, frames = row["Timecode"].split(":")
    return 3600 * int(hours) + 60 * int(minutes) + int(whole) + float(frames) / FRAME_RATE


def read_weights(file):
    """Times in seconds from the first row, and for each column its values; empty cells repeat the last value."""
    if not os.path.isfile(file):
        raise InputError(f"{file}: no such file")
    with open(file, newline="", encoding="utf-8-sig") as stream:
        rows = list(csv.DictReader(stream))
    if not rows or not {"time_s", "time", "timestamp", "Timecode"} & set(rows[0]):
        raise InputError(f"{file}: expected rows, and a column time_s, time, timestamp or Timecode")
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
    curves, path = curve.action.fcurves, f'key_blocks["{name}"].value'
    if curves.find(path):  # of a recording that was played before
        curves.remove(curves.find(path))
    points = curves.new(path).keyframe_points
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
        key.driver_remove("value")  # of a recording that was played before
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


def film(scene):
    """A camera, three lamps and a renderer for a portrait of the face."""
    for material in bpy.data.materials:
        material.cycles.sample_as_light = False  # unlit parts are no lamps: as such they only make noise
    eyes = [bpy.data.objects[name].matrix_world.translation for name in ("eye_R", "eye_L") if name in bpy.data.objects]
    if len(eyes) == 2:
        at = (eyes[0] + eyes[1]) / 2 + mathutils.Vector((0, 0, -0.042))
    else:
        skin = max(meshes_with_shapes(), key=lambda item: len(item.data.vertices))
        at = skin.matrix_world @ (sum((mathutils.Vector(corner) for corner in skin.bound_box), mathutils.Vector()) / 8)

    def place(name, data, offset):
        thing = bpy.data.objects.new(name, data)
        thing.location = at + mathutils.Vector(offset)
        thing.rotation_euler = (at - thing.location).to_track_quat("-Z", "Y").to_euler()
        scene.collection.objects.link(thing)
        return thing

    scene.camera = place("camera", bpy.data.cameras.new("camera"), (0.16, -0.62, 0.02))  # as far as a portrait is taken
    scene.camera.data.lens = 105
    for name, offset, watts, metres in (("key", (0.45, -0.65, 0.3), 8, 0.35), ("fill", (-0.6, -0.5, 0.05), 3, 0.6),
                                        ("rim", (-0.3, 0.6, 0.4), 5, 0.3)):
        lamp = bpy.data.lights.new(name, "AREA")
        lamp.energy, lamp.size = watts, metres
        place(name, lamp, offset)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"].inputs
    background[0].default_value, background[1].default_value = (0.62, 0.64, 0.66, 1), 0.6
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 48
    scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = 600, 716


def colour_of(material):
    """The output socket that gives a material its colour, or the colour where there is none; and the roughness, None
    where the material is unlit."""
    for node in material.node_tree.nodes:
        for name in ("Base Color", "Color"):
            if node.type in ("BSDF_PRINCIPLED", "EMISSION", "BACKGROUND") and name in node.inputs:
                socket = node.inputs[name]
                roughness = node.inputs["Roughness"].default_value if "Roughness" in node.inputs else None
                return (socket.links[0].from_socket if socket.links else tuple(socket.default_value)), roughness
    return (1, 1, 1, 1), 1


def fill_gaps(image):
    """Gives pixels between the parts of a baked texture the mean colour, as programs look beyond a part's edge."""
    pixels = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(pixels)
    rows = pixels.reshape(-1, 4)
    gap = rows[:, 3] == 0
    rows[gap, :3] = rows[~gap, :3].mean(axis=0)
    rows[:, 3] = 1
    image.pixels.foreach_set(pixels)


def bake_colours(item):
    """Puts the colours of a mesh's vertices and materials into a texture, so that any program shows them.

    A material that has a texture keeps it, and with it its mesh.
    """
    if any(node.type == "TEX_IMAGE" for slot in item.material_slots for node in slot.material.node_tree.nodes):
        return
    for slot in item.material_slots:  # meshes share materials, but not this texture
        slot.material = slot.material.copy()
    materials = [slot.material for slot in item.material_slots]
    bpy.ops.object.select_all(action="DESELECT")
    item.select_set(True)
    bpy.context.view_layer.objects.active = item
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(island_margin=0.002)
    bpy.ops.object.mode_set(mode="OBJECT")
    size = SKIN_TEXTURE_PIXELS if item.data.name.startswith("skin") else TEXTURE_PIXELS
    image = bpy.data.images.new(item.name, size, size, alpha=True)
    image.generated_color = (0, 0, 0, 0)
    rough = []
    for material in materials:
        nodes, links = material.node_tree.nodes, material.node_tree.links
        colour, roughness = colour_of(material)
        rough.append(roughness)
        glow = nodes.new("ShaderNodeEmission")
        if isinstance(colour, tuple):
            glow.inputs["Color"].default_value = colour
        else:
            links.new(colour, glow.inputs["Color"])
        output = next(node for node in nodes if node.type == "OUTPUT_MATERIAL")
        links.new(glow.outputs[0], output.inputs["Surface"])
        nodes.active = nodes.new("ShaderNodeTexImage")
        nodes.active.image = image
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False  # Debian's Blender has no denoiser, and bakes black with one
    bpy.ops.object.bake(type="EMIT", margin=4, use_clear=False)
    fill_gaps(image)
    # The FBX exporter identifies a texture by its file path. Textures without a path would be taken for one and the same.
    image.filepath_raw = f"//{item.name}.png"
    image.pack()
    for material, roughness in zip(materials, rough):
        material.node_tree.nodes.clear()
        nodes, links = material.node_tree.nodes, material.node_tree.links
        surface, output = nodes.new("ShaderNodeBsdfPrincipled"), nodes.new("ShaderNodeOutputMaterial")
        picture = nodes.new("ShaderNodeTexImage")
        picture.image = image
        if roughness is None:  # unlit: it shines by itself
            surface.inputs["Base Color"].default_value = (0, 0, 0, 1)
            links.new(picture.outputs["Color"], surface.inputs["Emission"])
        else:
            surface.inputs["Roughness"].default_value = roughness
            links.new(picture.outputs["Color"], surface.inputs["Base Color"])
        links.new(surface.outputs[0], output.inputs["Surface"])


def save(out, strongest_frame):
    kind = os.path.splitext(out)[1].lower()
    scene = bpy.context.scene
    if kind == ".blend":
        bpy.ops.wm.save_as_mainfile(filepath=out)
    elif kind == ".fbx":
        for item in [item for item in bpy.data.objects if item.type == "MESH"]:
            bake_colours(item)
        # One animation of the whole scene: when it exports each action, the exporter omits shape keys.
        bpy.ops.export_scene.fbx(
            filepath=out, path_mode="COPY", embed_textures=True, bake_anim_use_all_actions=False,
            bake_anim_use_nla_strips=False)
    elif kind == ".glb":
        bpy.ops.export_scene.gltf(filepath=out)
    elif kind == ".png":
        film(scene)
        scene.frame_set(strongest_frame)
        scene.render.filepath = out
        bpy.ops.render.render(write_still=True)
    else:
        film(scene)
        scene.frame_step = FRAME_RATE // FILM_FRAME_RATE
        scene.render.fps = FILM_FRAME_RATE
        scene.render.image_settings.file_format = "FFMPEG"
        scene.render.ffmpeg.format, scene.render.ffmpeg.codec = "MPEG4", "H264"
        scene.render.filepath = out
        bpy.ops.render.render(animation=True)


def meshes_with_shapes():
    return [item for item in bpy.data.objects if item.type == "MESH" and item.data.shape_keys]


def play(recording, with_drivers):
    """Animates the rig of the scene by a recording. The number of rows, their last time, and the frame of most motion."""
    times, weights = read_weights(recording)
    scene = bpy.context.scene
    scene.render.fps = FRAME_RATE
    scene.frame_start, scene.frame_end = 1, 1 + round(times[-1] * FRAME_RATE)
    moving = 0
    meshes = meshes_with_shapes()
    skin = max((item.data.shape_keys for item in meshes), key=lambda keys: len(keys.key_blocks), default=None)
    for item in meshes:
        animated = key_shapes(item.data, skin, times, weights)
        moving += animated
        print(f"{item.name}: {animated} shapes move")
        if with_drivers:
            correctives = drive_correctives(item.data, skin)
        else:
            correctives = key_correctives(item.data, skin, times, weights)
        if correctives:
            print(f"{item.name}: {correctives} correctives follow")
    if moving == 0:
        raise InputError(f"{recording}: no column is named after a shape of the rig with a weight other than 0")
    still = still_shapes(skin, weights)
    if still:
        print(f"{len(still)} shapes have no weight in {recording}: {', '.join(still)}")
    sums = [sum(values) for values in zip(*(weights[name.lower()] for name in shape_names(skin) if name.lower() in weights))]
    return len(times), times[-1], 1 + round(times[sums.index(max(sums))] * FRAME_RATE)


def shape_names(skin):
    """The skin's shapes but for its rest and the correctives."""
    names = [key.name for key in skin.key_blocks]
    return [name for name in names if name != "Basis" and not corrected(name, skin.key_blocks)]


def still_shapes(skin, weights):
    """The skin's shapes that a recording does not move."""
    return [name for name in shape_names(skin) if not any(weights.get(name.lower(), ()))]


def main(rig, recording, out):
    if not os.path.isfile(rig):
        sys.exit(f"{rig}: no such file")
    if os.path.splitext(out)[1].lower() not in (".blend", ".fbx", ".glb", ".png", ".mp4"):
        sys.exit(f"{out}: expected .blend, .fbx, .glb, .png or .mp4")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=rig)
    try:
        rows, seconds_long, strongest = play(recording, out.lower().endswith(".blend"))
    except InputError as error:
        sys.exit(str(error))
    save(os.path.abspath(out), strongest)
    print(f"{rows} samples over {seconds_long:.1f} s, written to {out}")


def register():
    """Called by Blender where this file is installed as an add-on."""

    class ImportRig(bpy.types.Operator):
        """A face with ARKit's shapes, as hyperex rig writes it"""
        bl_idname, bl_label = "import_scene.hyperex_rig", "Hyperex rig (.glb)"
        filepath: bpy.props.StringProperty(subtype="FILE_PATH")
        filter_glob: bpy.props.StringProperty(default="*.glb", options={"HIDDEN"})

        def execute(self, context):
            return bpy.ops.import_scene.gltf(filepath=self.filepath)

        def invoke(self, context, event):
            context.window_manager.fileselect_add(self)
            return {"RUNNING_MODAL"}

    class PlayWeights(bpy.types.Operator):
        """Weights of ARKit's shapes over time, for the rig in the scene"""
        bl_idname, bl_label = "import_anim.hyperex_weights", "Weights for a Hyperex rig (.csv)"
        filepath: bpy.props.StringProperty(subtype="FILE_PATH")
        filter_glob: bpy.props.StringProperty(default="*.csv", options={"HIDDEN"})

        def execute(self, context):
            try:
                play(self.filepath, True)
            except InputError as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
            return {"FINISHED"}

        def invoke(self, context, event):
            context.window_manager.fileselect_add(self)
            return {"RUNNING_MODAL"}

    def entries(menu, context):
        for operator in (ImportRig, PlayWeights):
            menu.layout.operator(operator.bl_idname, text=operator.bl_label)

    for operator in (ImportRig, PlayWeights):
        bpy.utils.register_class(operator)
    bpy.types.TOPBAR_MT_file_import.append(entries)
    register.undo = (entries, (ImportRig, PlayWeights))


def unregister():
    entries, operators = register.undo
    bpy.types.TOPBAR_MT_file_import.remove(entries)
    for operator in operators:
        bpy.utils.unregister_class(operator)


if __name__ == "__main__" and bpy.app.background:
    given = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if len(given) != 3:
        sys.exit("expected after --: RIG.glb WEIGHTS.csv OUT.blend")
    main(*given)
