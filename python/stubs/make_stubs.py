# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the type stubs of the module `hyperex`: make_stubs.py FILE.

Signatures are those that pybind11 writes into docstrings. Classes of options have the types of
their fields in `__annotations__`.
"""
import ast
import inspect
import pathlib
import sys

import hyperex

HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
# Types for editors and checkers; shapes and units are in the docstrings (help(hyperex.Simulator)).
# Made by python/stubs/make_stubs.py.
import os
import pathlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str
'''
# The headings, before the first name of each subject.
GROUPS = {"TriMesh": "Scans, landmarks, faces", "Motion": "Motions", "DepthAt": "Tissue",
          "Obstacles": "Teeth and eyes", "BoneLayer": "Options of a simulation",
          "SimulationReport": "The simulation", "TissuePoint": "Tissue that differs from place to place",
          "SideExcursion": "Measures", "GlbReport": "Files for other programs", "Scene": "Scene files"}
SPECIAL = ("__init__", "__len__", "__getitem__", "__contains__", "__copy__")


class Types(ast.NodeTransformer):
    """A type of pybind11's as one of Python's: an argument takes more than a result promises."""

    def __init__(self, argument):
        self.argument = argument

    def visit_Attribute(self, node):
        name = ast.unparse(node)
        if name.startswith("hyperex."):
            return ast.Name(node.attr)
        if name == "numpy.ndarray":
            return ast.parse("ArrayLike" if self.argument else "NDArray[Any]", mode="eval").body
        if name == "os.PathLike":
            return ast.parse("str | os.PathLike[str]" if self.argument else "pathlib.Path",
                             mode="eval").body
        return node

    def visit_Name(self, node):
        return ast.Name({"object": "Any", "handle": "Any", "function": "Callable[..., Any]",
                         "buffer": "Any"}.get(node.id, node.id))

    def visit_Subscript(self, node):
        name = ast.unparse(node.value)
        if name == "numpy.ndarray":  # numpy.ndarray[numpy.float64[m, 3], flags.writeable]
            scalar = ast.unparse(node.slice).replace("numpy.", "np.").strip("()").split(",")[0]
            scalar = scalar.split("[")[0]
            return ast.parse("ArrayLike" if self.argument else f"NDArray[{scalar}]",
                             mode="eval").body
        inner = ast.unparse(self.visit(node.slice))
        if name == "Optional":
            text = f"{inner} | None"
        elif name == "Union":
            text = " | ".join(ast.unparse(self.visit(one)) for one in node.slice.elts)
        elif name == "List":
            text = f"{'Sequence' if self.argument else 'list'}[{inner}]"
        elif name == "Dict":
            text = f"{'Mapping' if self.argument else 'dict'}[{inner.strip('()')}]"
        elif name == "Tuple":
            text = f"tuple[{inner.strip('()')}]"
        else:
            text = f"{name}[{inner.strip('()')}]"
        return ast.parse(text, mode="eval").body


def default(node):
    """A number, a text or None as it is; anything else as `...`."""
    return node if isinstance(node, ast.Constant) else ast.Constant(...)


def function(signature, method):
    """The definition with Python's types: `signature` is a line of a docstring."""
    node = ast.parse(f"def {signature}: ...").body[0]
    arguments = node.args
    for one in arguments.posonlyargs + arguments.args + arguments.kwonlyargs:
        one.annotation = one.annotation and Types(True).visit(one.annotation)
    if method:
        (arguments.posonlyargs + arguments.args)[0].annotation = None
    arguments.defaults = [default(one) for one in arguments.defaults]
    arguments.kw_defaults = [one and default(one) for one in arguments.kw_defaults]
    for rest in (arguments.vararg, arguments.kwarg):
        if rest:
            rest.annotation = ast.Name("Any")
    node.returns = node.returns and Types(False).visit(node.returns)
    return ast.unparse(ast.fix_missing_locations(node)).replace(":\n    ...", ": ...")


def signatures(name, doc):
    """The lines of a docstring that are signatures."""
    lines = [line.split(". ", 1)[-1] if line[:1].isdigit() else line for line in doc.splitlines()]
    found = [line for line in lines if line.startswith(name + "(") and " -> " in line]
    return found[:1] if "Overloaded function" not in doc else found


def definitions(name, member, method):
    found = signatures(name, member.__doc__ or "")
    mark = ["@overload"] if len(found) > 1 else []
    return [line for one in found for line in [*mark, function(one, method)]]


def property_of(name, member):
    getter = member.fget.__doc__.splitlines()[0]  # (self: hyperex._hyperex.Scan) -> str
    return ["@property", function(f"{name}{getter}", True)]


def options_class(cls):
    fields = cls.__annotations__
    keywords = ", ".join(f"{name}: {kind} = ..." for name, kind in fields.items())
    return [f"{name}: {kind}" for name, kind in fields.items()] + [
        f"def __init__(self, *, {keywords}) -> None: ...",
        f"def replace(self, *, {keywords}) -> {cls.__name__}: ..."]


def class_lines(cls):
    if "__annotations__" in vars(cls):
        return options_class(cls)
    lines = []
    for name, member in vars(cls).items():
        if isinstance(member, property):
            lines += property_of(name, member)
        elif name in SPECIAL or (not name.startswith("_") and callable(member)):
            lines += definitions(name, member, True)
    return lines


def main(file):
    lines = [HEAD]
    for name, thing in vars(hyperex._hyperex).items():  # in the order of the definitions
        if name.startswith("_"):
            continue
        if name in GROUPS:
            lines.append(f"\n# {GROUPS[name]}\n")
        if not inspect.isclass(thing):
            lines += definitions(name, thing, False)
        elif issubclass(thing, Exception):
            lines.append(f"class {name}({thing.__base__.__name__}): ...")
        else:
            body = "".join(f"\n    {line}" for line in class_lines(thing)) or " ..."
            lines.append(f"class {name}:{body}\n")
    file.write_text("\n".join([*lines, ""]))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
