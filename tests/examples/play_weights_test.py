#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Correctives in examples/blender/play_weights.py, without Blender: play_weights_test.py EXAMPLES

Blender's objects are stood in for by the few members that the script uses. No test runs correctives in Blender itself:
the tutorial for artists runs the script there, where Blender is installed, on a rig without them.
"""
import importlib.util
import pathlib
import sys
import types
import unittest


class Named(dict):
    """A collection of Blender's: by name, and in order."""

    def __init__(self, names, make):
        super().__init__((name, make(name)) for name in names)

    def __iter__(self):
        return iter(self.values())


class Key:
    def __init__(self, name):
        self.name, self.driver = name, None

    def driver_remove(self, member):
        assert member == "value"
        self.driver = None

    def driver_add(self, member):
        assert member == "value"
        variables = types.SimpleNamespace(all=[])

        def new():
            variables.all.append(types.SimpleNamespace(targets=[types.SimpleNamespace()]))
            return variables.all[-1]

        variables.new = new
        self.driver = types.SimpleNamespace(variables=variables)
        return types.SimpleNamespace(driver=self.driver)


class Curve:
    def __init__(self):
        self.keyframe_points = self
        self.points = []

    def add(self, count):
        self.points = [types.SimpleNamespace() for _ in range(count)]

    def __iter__(self):
        return iter(self.points)


def mesh_of(*names):
    curves = {}

    def new(path):
        assert path not in curves, "Blender refuses a second curve"
        curves[path] = Curve()
        return curves[path]

    def remove(curve):
        del curves[next(path for path, one in curves.items() if one is curve)]

    action = types.SimpleNamespace(fcurves=types.SimpleNamespace(new=new, find=curves.get, remove=remove))
    keys = types.SimpleNamespace(key_blocks=Named(("Basis", *names), Key),
                                 animation_data_create=lambda: types.SimpleNamespace(action=action))
    return types.SimpleNamespace(name="mesh", shape_keys=keys, curves=curves)


def load(examples):
    """The script as a module, with modules that are empty in place of Blender's."""
    sys.dont_write_bytecode = True  # into the folder of examples
    for name in ("numpy", "bpy", "mathutils"):
        sys.modules[name] = types.ModuleType(name)
    spec = importlib.util.spec_from_file_location("play_weights", pathlib.Path(examples) / "blender/play_weights.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    return script


class Correctives(unittest.TestCase):
    TIMES = [0, 1]
    WEIGHTS = {"jawopen": [0.5, 1], "mouthclose": [0, 0.4], "jawopen_mouthclose": [9, 9]}

    def setUp(self):
        self.face = mesh_of("jawOpen", "mouthClose", "mouthFunnel", "mouthSmile_L", "jawOpen_mouthClose",
                            "jawOpen_mouthFunnel")
        self.teeth = mesh_of("jawOpen", "jawOpen_mouthClose")
        self.skin = self.face.shape_keys

    @staticmethod
    def values(mesh, name):
        return [point.co[1] for point in mesh.curves[f'key_blocks["{name}"].value']]

    def test_names(self):
        names = self.skin.key_blocks
        self.assertEqual(script.corrected("jawOpen_mouthClose", names), ("jawOpen", "mouthClose"))
        self.assertEqual(script.corrected("mouthSmile_L_mouthFunnel", names), ("mouthSmile_L", "mouthFunnel"))
        for other in ("jawOpen", "mouthSmile_L", "jawOpen_L", "jawOpen_jawOpen", "Basis"):
            self.assertIsNone(script.corrected(other, names), other)

    def test_drivers_multiply_the_values_of_the_skin(self):
        for mesh, count in ((self.face, 2), (self.teeth, 1)):
            self.assertEqual(script.drive_correctives(mesh, self.skin), count)
            keys = mesh.shape_keys.key_blocks
            self.assertIsNone(keys["jawOpen"].driver)
            driver = keys["jawOpen_mouthClose"].driver
            self.assertEqual((driver.type, driver.expression), ("SCRIPTED", "a * b"))
            self.assertEqual([variable.name for variable in driver.variables.all], ["a", "b"])
            targets = [variable.targets[0] for variable in driver.variables.all]
            for target, name in zip(targets, ("jawOpen", "mouthClose")):
                self.assertEqual(target.id_type, "KEY")
                self.assertIs(target.id, self.skin)
                self.assertEqual(target.data_path, f'key_blocks["{name}"].value')

    def test_keys_are_products(self):
        for mesh in (self.face, self.teeth):
            self.assertEqual(script.key_correctives(mesh, self.skin, self.TIMES, self.WEIGHTS), 1)
            values = self.values(mesh, "jawOpen_mouthClose")
            self.assertEqual((values[0], values[-1]), (0, 0.4))
        self.assertEqual(len(self.face.curves), 1, "nothing is known of mouthFunnel")

    def test_between_two_rows_keys_are_products_too(self):
        self.assertEqual(script.key_correctives(
            self.teeth, self.skin, [0, 1, 1.09], {"jawopen": [0, 1, 1], "mouthclose": [0, 1, 0]}), 1)
        points = self.teeth.curves['key_blocks["jawOpen_mouthClose"].value'].points
        value = {round(frame, 6): key for frame, key in (point.co for point in points)}
        self.assertAlmostEqual(value[31], 0.25)  # the frame in the middle of the first two rows
        self.assertEqual(list(value), [*range(1, 67), 66.4])
        self.assertAlmostEqual(value[63], 1 - 2 / 60 / 0.09)

    def test_a_corrective_may_move_between_rows_alone(self):
        self.assertEqual(script.key_correctives(
            self.teeth, self.skin, [0, 1], {"jawopen": [0, 1], "mouthclose": [1, 0]}), 1)
        self.assertAlmostEqual(max(self.values(self.teeth, "jawOpen_mouthClose")), 0.25)

    def test_a_column_of_their_name_is_passed_over(self):
        self.assertEqual(script.key_shapes(self.face, self.skin, self.TIMES, self.WEIGHTS), 2)
        self.assertEqual(self.values(self.face, "jawOpen"), [0.5, 1])
        self.assertEqual(len(self.face.curves), 2)


class Shapes(unittest.TestCase):
    def test_a_second_recording_replaces_the_first(self):
        mesh = mesh_of("jawOpen")
        for values in ([0, 1], [0, 0.5]):
            self.assertEqual(script.key_shapes(mesh, mesh.shape_keys, [0, 1], {"jawopen": values}), 1)
        curve = mesh.curves['key_blocks["jawOpen"].value']
        self.assertEqual([point.co[1] for point in curve.points], [0, 0.5])

    def test_those_without_a_weight_are_listed(self):
        skin = mesh_of("jawOpen", "mouthClose", "eyeBlinkLeft", "jawOpen_mouthClose").shape_keys
        self.assertEqual(script.still_shapes(skin, {"jawopen": [0, 1], "eyeblinkleft": [0, 0]}), ["mouthClose", "eyeBlinkLeft"])

    def test_no_known_output_is_refused_before_the_rig_is_read(self):
        for rig, out, said in (("nowhere.glb", "face.blend", "no such file"), (__file__, "face.usd", "expected .blend")):
            with self.assertRaises(SystemExit) as refused:
                script.main(rig, "weights.csv", out)
            self.assertIn(said, str(refused.exception))


script = load(sys.argv[1])
unittest.main(argv=sys.argv[:1])
