# SPDX-License-Identifier: GPL-3.0-or-later
"""The type stubs name what the module has, with the types that its values have."""
import ast
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import hyperex
import numpy as np

from support import coarse_mesh, face, small_simulator

STUBS = pathlib.Path(hyperex.__file__).with_name("__init__.pyi")
PLAIN = {"float": (float, int), "int": (int,), "bool": (bool,), "str": (str,), "dict": (dict,)}


def public(names):
    return {name for name in names if not name.startswith("_")}


def members(node):
    names = set()
    for part in node.body:
        if isinstance(part, (ast.FunctionDef, ast.ClassDef)):
            names.add(part.name)
        elif isinstance(part, ast.AnnAssign):
            names.add(part.target.id)
    return names


def conforms(value, kind):
    """Whether a value is of the type that an expression of the stubs says."""
    if isinstance(kind, ast.BinOp):
        return conforms(value, kind.left) or conforms(value, kind.right)
    if isinstance(kind, ast.Constant):
        return value is kind.value
    text = ast.unparse(kind)
    if text == "pathlib.Path" or text == "os.PathLike[str]":
        return isinstance(value, pathlib.Path)
    if text == "Any":
        return True
    if text in PLAIN:
        return type(value) in PLAIN[text]
    if isinstance(kind, ast.Name):
        return isinstance(value, getattr(hyperex, text))
    name, inner = ast.unparse(kind.value), kind.slice
    if name == "NDArray":
        return isinstance(value, np.ndarray) and (
            ast.unparse(inner) == "Any" or value.dtype == getattr(np, inner.attr))
    if name == "Literal":
        return value in ast.literal_eval(inner)
    if name in ("list", "Sequence"):
        return isinstance(value, list if name == "list" else tuple) and all(
            conforms(one, inner) for one in value)
    if name in ("dict", "Mapping"):
        return isinstance(value, dict) and all(
            conforms(k, inner.elts[0]) and conforms(v, inner.elts[1]) for k, v in value.items())
    raise AssertionError(f"a type without a check: {text}")


class Stubs(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(STUBS.read_text())
        self.classes = {node.name: node for node in self.tree.body if isinstance(node, ast.ClassDef)}
        self.functions = [node for node in self.tree.body if isinstance(node, ast.FunctionDef)]

    def test_names(self):
        self.assertEqual(public(members(self.tree)), set(hyperex.__all__))
        self.assertTrue(STUBS.with_name("py.typed").exists())

    def test_members_of_classes(self):
        for name, node in self.classes.items():
            with self.subTest(name):
                real = getattr(hyperex, name)
                if not issubclass(real, Exception):
                    self.assertEqual(public(members(node)), public(vars(real)))

    def test_arguments(self):
        for node in self.functions:
            with self.subTest(node.name):
                said = getattr(hyperex, node.name).__doc__
                for argument in node.args.args + node.args.kwonlyargs:
                    self.assertIn(f"{argument.arg}: ", said)
                    self.assertIsNotNone(argument.annotation)
                self.assertIsNotNone(node.returns)

    def check_value(self, value):
        """All fields and properties of an object have the types that the stubs give them."""
        checked = 0
        for part in self.classes[type(value).__name__].body:
            kind = part.annotation if isinstance(part, ast.AnnAssign) else (
                part.returns if ast.unparse(part.decorator_list[:1]) == "property" else None)
            if kind:
                name = part.target.id if isinstance(part, ast.AnnAssign) else part.name
                with self.subTest(f"{type(value).__name__}.{name}"):
                    self.assertTrue(conforms(getattr(value, name), kind), ast.unparse(kind))
                    checked += 1
        return checked

    def test_types_of_options(self):
        checked = 0
        for name, node in self.classes.items():
            if any(isinstance(part, ast.AnnAssign) for part in node.body):
                checked += self.check_value(getattr(hyperex, name)())
        self.assertGreater(checked, 70)

    def test_types_of_values(self):
        simulator = small_simulator()
        run = simulator.run()
        checked = sum(self.check_value(value) for value in (
            face(), face().scan, face().mesh, coarse_mesh(), simulator.motion,
            simulator.motion.motion, simulator, run, run.report))
        self.assertGreater(checked, 60)

    def test_a_type_that_is_wrong_is_seen(self):
        for value, kind in ((1.0, "int"), ("tied", 'Literal["held", "free"]'), (True, "float"),
                            (np.zeros(2), "NDArray[np.float32]"), ([1], "list[str]"),
                            (None, "float | str")):
            self.assertFalse(conforms(value, ast.parse(kind, mode="eval").body), kind)

    def test_docstrings(self):
        for name in hyperex.__all__:
            lines = (getattr(hyperex, name).__doc__ or "").strip().splitlines()
            described = [line for line in lines if line and not line.startswith(name + "(")]
            self.assertTrue(described, name)

    @unittest.skipIf(shutil.which("mypy") is None, "mypy is not installed")
    def test_a_type_checker_reads_them(self):
        wrong = {"hyperex.SupportOptions(skull='tied')", "hyperex.DriveOptions(gain='much')",
                 "hyperex.read_face(3)", "hyperex.embedded_face().points"}
        right = ["hyperex.SupportOptions(skull='held', field_pa_per_m=0)",
                 "hyperex.read_face('me.ply').mesh.points_m.mean()",
                 "hyperex.SimulationOptions(time=hyperex.TimeOptions(step_s=0.001))"]
        lines = ["import hyperex", *right, *sorted(wrong)]
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "program.py")
            program.write_text("\n".join(lines))
            said = subprocess.run(["mypy", "--cache-dir", folder, str(program)],
                                  capture_output=True, text=True).stdout
        found = {lines[int(line.split(":")[1]) - 1] for line in said.splitlines()
                 if line.startswith(str(program))}
        self.assertEqual(found, wrong, said)


if __name__ == "__main__":
    unittest.main()
