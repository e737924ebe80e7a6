# SPDX-License-Identifier: GPL-3.0-or-later
"""The type stubs name what the module has, no more and no less, and everything has a docstring."""
import ast
import pathlib
import unittest

import hyperex

STUBS = pathlib.Path(hyperex.__file__).with_name("__init__.pyi")


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


class Stubs(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(STUBS.read_text())

    def test_names(self):
        self.assertEqual(public(members(self.tree)), set(hyperex.__all__))
        self.assertTrue(STUBS.with_name("py.typed").exists())

    def test_members_of_classes(self):
        for node in self.tree.body:
            if not isinstance(node, ast.ClassDef):
                continue
            with self.subTest(node.name):
                real = getattr(hyperex, node.name)
                if not issubclass(real, Exception):
                    self.assertEqual(public(members(node)), public(vars(real)))

    def test_arguments(self):
        for node in self.tree.body:
            if not isinstance(node, ast.FunctionDef) or node.decorator_list:
                continue
            with self.subTest(node.name):
                said = getattr(hyperex, node.name).__doc__
                for argument in node.args.args + node.args.kwonlyargs:
                    self.assertIn(f"{argument.arg}: ", said)

    def test_docstrings(self):
        for name in hyperex.__all__:
            lines = (getattr(hyperex, name).__doc__ or "").strip().splitlines()
            described = [line for line in lines if line and not line.startswith(name + "(")]
            self.assertTrue(described, name)


if __name__ == "__main__":
    unittest.main()
