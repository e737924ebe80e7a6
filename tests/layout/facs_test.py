#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables "Which muscle makes which shape" of docs/muscles.md agree with each other and with what bench/facs.py holds.

    facs_test.py REPOSITORY

In the table of shapes the right ones are bold and have their share in brackets. Counted again, they must give the counts
of the table below it, and their means its shares. Each count must be the one that LEAST of bench/facs.py asks for, and
no share may be below it. Then figures are changed, one at a time, and each change must be seen.
"""
import ast
import re
import sys
from pathlib import Path

HEADING = "## Which muscle makes which shape"
SUMMARY = ("right, of the first ", "right, of all ", "share of the right ones, mean of the first ", "the same of all ",
           "greatest while the jaw opens")


def cells(line):
    return [cell.strip() for cell in line.strip("|").split("|")]


def tables_of(page):
    section = page[page.index(HEADING):]
    section = section[:section.find("\n## ", 1)]
    return [[cells(line) for line in block.splitlines()] for block in re.findall(r"(?:^\|.*\n)+", section, re.M)]


def constants_of(program):
    """LEAST, FIRST and JAW_MOST, read without running the program, which needs more than Python."""
    return {
        node.targets[0].id: ast.literal_eval(node.value)
        for node in ast.parse(program).body
        if isinstance(node, ast.Assign) and node.targets[0].id in ("LEAST", "FIRST", "JAW_MOST")
    }


def counted(rows, column, first):
    """What the column of the table of shapes gives: of the first and of all, right ones and mean shares; the jaw."""
    shapes = [row[column] for row in rows if "(" in row[column]]
    jaws = [float(row[column].split()[-1]) for row in rows if "(" not in row[column]]
    right = [cell.startswith("**") for cell in shapes]
    share = [float(re.search(r"\(([\d.]+)\)", cell).group(1)) for cell in shapes]
    return sum(right[:first]), sum(right), sum(share[:first]) / first, sum(share) / len(share), max(jaws)


def check(page, program):
    """Sentences on what differs."""
    shapes, summary = tables_of(page)[:2]
    held = constants_of(program)
    said = []
    if shapes[0][1:] != summary[0][1:] or not all(
            row[0].startswith(words) for row, words in zip(summary[2:], SUMMARY)) or len(summary) != 2 + len(SUMMARY):
        return ["the tables have other columns or rows"]
    for column, name in enumerate(shapes[0][1:], 1):
        subject, points = name.split(", ")
        least = held["LEAST"][points][subject]
        stated = [float(row[column]) for row in summary[2:]]
        # Shares in the table of shapes are rounded, and so are their means.
        for row, a, b, off in zip(summary[2:], stated, counted(shapes[2:], column, held["FIRST"]), (0, 0, 0.01, 0.01, 0)):
            if abs(a - b) > off + 1e-9:
                said.append(f"{name}: {row[0]}: {a:g}, counted {b:.4g}")
        if stated[0] != least[0] or stated[1] != least[1]:
            said.append(f"{name}: {stated[:2]} right, bench/facs.py holds {least[:2]}")
        if any(not -1e-9 <= a - b <= 0.02 + 1e-9 for a, b in zip(stated[2:4], least[2:])):
            said.append(f"{name}: shares {stated[2:4]}, bench/facs.py holds {least[2:]}")
        if stated[4] > held["JAW_MOST"]:
            said.append(f"{name}: the jaw leaves {stated[4]}, bench/facs.py allows {held['JAW_MOST']}")
    return said


def changed_pages(page):
    """The page with one figure of the second table made another."""
    for row in tables_of(page)[1][2:]:
        line = f"| {' | '.join(row)} |"
        for column in range(1, len(row)):
            other = row[:column] + [f"{float(row[column]) + (0.03 if '.' in row[column] else 1):g}"] + row[column + 1:]
            yield f"{row[0]}: {other[column]}", page.replace(line, f"| {' | '.join(other)} |")


def main(folder):
    root = Path(folder)
    page = (root / "docs/muscles.md").read_text(encoding="utf-8")
    program = (root / "bench/facs.py").read_text(encoding="utf-8")
    said = check(page, program)
    changes = list(changed_pages(page)) if not said else []
    said += [f"not seen: {change}" for change, other in changes if not check(other, program)]
    print("\n".join(said) if said else f"both tables agree; {len(changes)} changes are seen")
    return 1 if said or not changes else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
