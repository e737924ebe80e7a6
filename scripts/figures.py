#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that a page which gathers figures of other pages invents none and keeps up with them:

    scripts/figures.py [PAGE]      by default docs/how_good.md; ends with 1 where a figure is not found

Every row of a table whose last column is "from" links there to the page that it comes from. Each number in the row's
other cells must stand in that page (`code`, as in commands and names, is left out, and so is the first column).
A command of the column "command" begins with a target of the Makefile (make X), a path or an installed program.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w]|\.\d)")
LINK = re.compile(r"\]\(([^)#]+)(?:#[^)]*)?\)")


def cells(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def numbers(text):
    return [number.lstrip("+") for number in NUMBER.findall(re.sub(r"`[^`]*`", "", text))]


def cannot_be_typed(command, targets):
    """Whether a command names what nobody has: a target that the Makefile lacks, or a program that is built but stands
    in no folder of programs."""
    words = re.sub(r"^([A-Z_]+=\S+ )+", "", command).split()
    if words[0] == "make":
        return len(words) < 2 or words[1] not in targets
    return "/" not in words[0] and words[0] not in ("hyperex", "cmake", "ctest")


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
        if source not in known:
            known[source] = set(numbers(source.read_text(encoding="utf-8")))
        for figure in numbers(" ".join(row[1:-1])):
            checked += 1
            if figure not in known[source]:
                print(f"{page.name}:{number}: {figure} does not stand in {source.name}")
                wrong += 1
    if wrong or not checked:
        print(f"figures: {wrong} of {checked} not found", file=sys.stderr)
        return 1
    print(f"figures: {checked} figures of {page.name} stand in the pages that it names")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
