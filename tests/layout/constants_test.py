#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table "All constants" of docs/muscles.md has the values of the template and of the code, and lacks none of them.

    constants_test.py REPOSITORY

A row names its constant as `FILE: NAME`, `FILE: STRUCT::NAME` or `FILE: NAME, NAME`. Its numbers are the constant's, in
the unit that follows them. Of the template, a row has one entry for each muscle that has the key: `zyg_major 2`, or its
name alone where the key is true. Then the table is changed, one value at a time, and each change must be seen; so must
a row that is gone.
"""
import functools
import re
import sys
import tomllib
from pathlib import Path

TEMPLATE = "muscles/data/muscles.toml"
HEADING = "## All constants"
# Every number of these must have a row.
WHOLE = (("simulate/options.hpp", "MuscleOptions"), ("muscles/force_shape.hpp", "ForceShape"),
         ("muscles/force_shape.hpp", "FoldShape"), ("simulate/load/shape_posterior.hpp", "PosteriorOptions"))
# Keys of the template that are words, or choose between words.
WORDS = ("name", "latin", "group", "branch", "kind", "lip")
NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?(?:\s*/\s*\d+)?"
UNITS = {"mm": 1e-3, "kPa/mm": 1e6}  # of members in SI; others are written as they are stored


def rows_of(page):
    section = page[page.index(HEADING):]
    section = section[:section.find("\n## ", 1)]
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in section.splitlines() if line.startswith("|")]
    return lines[2:]


def value(text):
    over, _, under = text.partition("/")
    return float(over) / float(under or 1)


def same(a, b):
    return len(a) == len(b) and all(abs(x - y) <= 1e-9 * max(abs(x), abs(y)) for x, y in zip(a, b))


def of_struct(text, struct):
    """The text of a struct, or of all where none is named, without comments."""
    text = re.sub(r"//.*", "", text)
    if not struct:
        return text
    found = re.search(rf"\bstruct {struct} \{{.*?\n\}};", text, re.S)
    return found.group() if found else ""


@functools.cache  # the page is checked some 200 times, the code stays as it is
def numbers_in_code(text, struct, name):
    found = re.search(rf"\b{name}(?:\[\d*\])?\s*=?\s*(\{{[^}}]*\}}|{NUMBER})", of_struct(text, struct))
    return [value(n) for n in re.findall(NUMBER, found.group(1))] if found else []


def in_the_page(cell, name):
    """The numbers of a cell in the unit of the code, whose name says in which."""
    unit = re.search(r"\d (mm|kPa/mm)$", cell)
    scaled = unit and not name.endswith("_mm")
    return [value(n) * (UNITS[unit.group(1)] if scaled else 1) for n in re.findall(NUMBER, cell)]


def of_muscles(muscles, key):
    """The entries that a row of this key must have."""
    out = {}
    for muscle in muscles:
        given = muscle.get(key)
        if isinstance(given, dict):
            out.update({f"{muscle['name']} with {other}": [float(v)] for other, v in given.items()})
        elif given is True:
            out[muscle["name"]] = []
        elif given is not None:
            out[muscle["name"]] = [float(v) for v in (given if isinstance(given, list) else [given])]
    return out


def check_template(cell, key, muscles, sources):
    if key == "path":
        return [] if in_the_page(cell, key) == [len(muscles)] else [f"{key}: {cell}, the template has {len(muscles)} rows"]
    wanted, found = of_muscles(muscles, key), {}
    for entry in re.findall(r"`([^`]+)`", cell):
        name, numbers = re.fullmatch(rf"(\w+(?: with \w+)?)((?:(?: to)? {NUMBER})*)", entry).groups()
        found[name] = [value(n) for n in re.findall(NUMBER, numbers)]
    said = [f"{key}: {name}: {found.get(name, 'no entry')}, the template has {wanted.get(name, 'none')}"
            for name in sorted(wanted.keys() | found.keys())
            if name not in wanted or name not in found or not same(found[name], wanted[name])]
    others = re.search(rf"all others ({NUMBER})", cell)
    struct, file = ("ForceShape", "muscles/force_shape.hpp") if key in ("band", "ramp") else (
        "TemplateMuscle", "muscles/muscle_template.hpp")
    if others and not same([value(others.group(1))], numbers_in_code(sources(file), struct, key)):
        said.append(f"{key}: all others {others.group(1)}, {file} has {numbers_in_code(sources(file), struct, key)}")
    return said


def check(page, muscles, sources):
    """Sentences on what differs. `sources`: the text of a file by its name."""
    said, seen = [], set()
    for constant, cell, where, kind, found_on in rows_of(page):
        file, _, names = where.strip("`").partition(": ")
        names = names.split(", ")
        seen |= {(file, name) for name in names}
        if kind not in ("anatomy", "mechanics", "model error", "regularisation", "definition") or not found_on:
            said.append(f"{constant}: no kind, or not what it was found on")
        if file == TEMPLATE:
            said += check_template(cell, names[0], muscles, sources)
            continue
        wanted = [n for name in names for n in numbers_in_code(sources(file), *name.rpartition("::")[::2])]
        if not wanted or not same(in_the_page(cell, names[0]), wanted):
            said.append(f"{constant}: {cell}, {file} has {wanted} for {', '.join(names)}")
    for key in sorted({key for muscle in muscles for key in muscle} - set(WORDS)):
        if (TEMPLATE, key) not in seen:
            said.append(f"{key} of the template has no row")
    for file, struct in WHOLE:
        for line in re.findall(r"^  (?:double|BoneLayer|Vec3) ([^()]*?);", of_struct(sources(file), struct), re.M | re.S):
            for name in re.findall(r"(\w+)\s*(?:=|\{)", line):
                if (file, f"{struct}::{name}") not in seen:
                    said.append(f"{struct}::{name} has no row")
    return said


def changed_pages(page):
    """The page, each time with one number of the table's values made another, or without a row that must be there."""
    needed = [f"{file}: {struct}::" for file, struct in WHOLE] + [f"{TEMPLATE}: "]
    for cells in rows_of(page):
        row = f"| {' | '.join(cells)} |"
        if cells[2].strip("`").startswith(tuple(needed)):
            yield f"no row {cells[0]}", page.replace(row + "\n", "")
        for number in re.finditer(r"(?<![\w.])" + NUMBER, cells[1]):
            other = f"{cells[1][:number.start()]}{number.group()}7{cells[1][number.end():]}"
            yield f"{cells[0]}: {other}", page.replace(row, row.replace(cells[1], other))


def main(folder):
    root, texts = Path(folder), {}

    def sources(name):
        path = root / name if name.startswith("scripts/") else root / "src/hyperex" / name
        return texts.setdefault(name, path.read_text(encoding="utf-8"))

    muscles = tomllib.loads(sources(TEMPLATE))["muscle"]
    page = (root / "docs/muscles.md").read_text(encoding="utf-8")
    said = check(page, muscles, sources)
    changed = list(changed_pages(page)) if not said else []
    said += [f"not seen: {change}" for change, other in changed if not check(other, muscles, sources)]
    print("\n".join(said) if said else f"{len(rows_of(page))} rows as in the code; {len(changed)} changes are seen")
    return 1 if said or not changed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
