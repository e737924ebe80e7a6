#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that a page which gathers figures of other pages invents none and keeps up with them:

    scripts/figures.py [PAGE]      by default docs/how_good.md; ends with 1 where a figure is not found

Every row of a table whose last column is "from" links there to the page that it comes from. Each number in the row's
other cells must stand in that page (`code`, as in commands and names, is left out, and so is the first column). Numbers
with a slash between them must stand together there.
A command of the column "command" begins with a target of the Makefile (make X), a path or an installed program.
Without PAGE, the decimals of README.md's section "How good is it?" must stand in docs/how_good.md too, and those of its
SENTENCES in their rows there. The figures of KEPT are those that tests/golden keeps of a run, rounded.
"""
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w]|\.\d)")
JOINED = re.compile(r"(?<![\w./])[+-]?\d+(?:\.\d+)?(?: / [+-]?\d+(?:\.\d+)?)+(?!\w|\.\d)")
SENTENCES = ((r"seven recorded points has ([\d.]+)\s+times", "real smile, 7 points: below the eyes / lips / cheeks"),)
# page, the first cell of a table's head, the first cell of its row, and the kept values of a cell, {} its column
KEPT = (("docs/symmetry.md", "element size, mm", "3.3 (default)",
         ("variants: {}: added_xi_difference", "variants: {}: added_xi_floor")),)
LINK = re.compile(r"\]\(([^)#]+)(?:#[^)]*)?\)")


def cells(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def numbers(text):
    return [number.lstrip("+") for number in NUMBER.findall(re.sub(r"`[^`]*`", "", text))]


def joined(text):
    """Figures with a slash between them, "0.57 / 0.46 / 0.45"."""
    return JOINED.findall(re.sub(r"`[^`]*`|\*", "", text))


def not_together(row, page):
    """Of the cells of a row: those figures with slashes that do not stand together in the text of a page."""
    known = [f" / {figures} / " for figures in joined(page)]
    return [figures for cell in row for figures in joined(cell) if not any(f" / {figures} / " in k for k in known)]


def cannot_be_typed(command, targets):
    """Whether a command names what nobody has: a target that the Makefile lacks, or a program that is built but stands
    in no folder of programs."""
    words = re.sub(r"^([A-Z_]+=\S+ )+", "", command).split()
    if words[0] == "make":
        return len(words) < 2 or words[1] not in targets
    return "/" not in words[0] and words[0] not in ("hyperex", "cmake", "ctest")


def of_its_row(text, page):
    """Complaints of sentences of README whose figure is not the first of the simulated column in the row of the page."""
    for words, label in SENTENCES:
        said = re.search(words, text)
        row = re.search(rf"^\| {re.escape(label)} \|[^|]*\|([^|]*)\|", page.read_text(encoding="utf-8"), re.MULTILINE)
        if not said or not row:
            yield f"README.md: nothing like {words!r}" if not said else f"{page.name}: no row {label!r}"
        elif said.group(1) != numbers(row.group(1))[0]:
            yield f"README.md: {said.group(1)} is {numbers(row.group(1))[0]} in {page.name}"


def not_as_kept(root):
    """Of the rows of KEPT: how many figures there are, and complaints of those that tests/golden keeps otherwise."""
    golden = json.loads((root / "tests/golden/demo_summary.json").read_text(encoding="utf-8"))["values"]
    count, complaints = 0, []
    for name, head, label, keys in KEPT:
        lines = (root / name).read_text(encoding="utf-8").splitlines()
        heads = next((cells(line) for line in lines if line.startswith(f"| {head} |")), [])
        row = next((cells(line) for line in lines if line.startswith(f"| {label} |")), [])
        if len(row) < 2 or len(row) != len(heads):
            complaints.append(f"{name}: no row {label} of a table that begins with {head}")
        for column, cell in zip(heads[1:], row[1:]):
            said = numbers(cell.replace("*", ""))
            kept = [golden[key.format(column)]["value"] for key in keys]
            count += len(said)
            decimals = [len(figure.partition(".")[2]) for figure in said]
            if len(said) != len(kept) or any(float(s) != round(k, d) for s, k, d in zip(said, kept, decimals)):
                complaints.append(f"{name}: {label}, {column}: {', '.join(said)}, tests/golden keeps "
                                  + ", ".join(f"{k:g}" for k in kept))
    return count, complaints


def not_in_the_page(readme, page):
    """Of README's section on how good it is: how many decimals there are, and complaints of those that the page lacks."""
    known, count, complaints, inside = set(numbers(page.read_text(encoding="utf-8"))), 0, [], False
    for number, line in enumerate(readme.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("## "):
            inside = line == "## How good is it?"
        for figure in numbers(line) if inside else ():
            if "." not in figure:
                continue
            count += 1
            if figure not in known:
                complaints.append(f"{readme.name}:{number}: {figure} does not stand in {page.name}")
    complaints += of_its_row(readme.read_text(encoding="utf-8"), page)
    return count, complaints


def main(arguments):
    if arguments and arguments[0] in ("-h", "--help"):
        print(__doc__)
        return 0
    page = Path(arguments[0]).resolve() if arguments else ROOT / "docs/how_good.md"
    known, wrong, checked, heads = {}, 0, 0, []
    targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if not line.startswith("|"):
            heads = []
            continue
        row = cells(line)
        if not heads:
            heads = row
        if heads[-1] != "from" or row == heads or set(line) <= set("|- :"):
            continue
        for command in re.findall(r"`([^`]+)`", row[heads.index("command")] if "command" in heads else ""):
            if cannot_be_typed(command, targets):
                print(f"{page.name}:{number}: nobody can type {command}")
                wrong += 1
        link = LINK.search(row[-1])
        if not link:
            print(f"{page.name}:{number}: the last cell does not link to a page")
            wrong += 1
            continue
        source = page.parent / link.group(1)
        text = source.read_text(encoding="utf-8")
        if source not in known:
            known[source] = set(numbers(text))
        for figures in not_together(row[1:-1], text):
            print(f"{page.name}:{number}: {figures} does not stand together in {source.name}")
            wrong += 1
        for figure in numbers(" ".join(row[1:-1])):
            checked += 1
            if figure not in known[source]:
                print(f"{page.name}:{number}: {figure} does not stand in {source.name}")
                wrong += 1
    if not arguments:
        of_readme, complaints = not_in_the_page(ROOT / "README.md", page)
        for complaint in complaints or ([] if of_readme else ["README.md: no figure in How good is it?"]):
            print(complaint)
            wrong += 1
        checked += of_readme
        as_kept, complaints = not_as_kept(ROOT)
        for complaint in complaints:
            print(complaint)
        wrong += len(complaints)
        checked += as_kept
    if wrong or not checked:
        print(f"figures: {wrong} of {checked} not found", file=sys.stderr)
        return 1
    print(f"figures: {checked} figures of {page.name} stand in the pages that it names")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
