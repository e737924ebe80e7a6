#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions and files stay short enough to be read at once.

    sizes_test.py SOURCE_FOLDER            fails where one is too long
    sizes_test.py SOURCE_FOLDER --list     prints the longest functions and files instead

Limits: a function has at most 60 lines, from its first line to its closing brace. Those of TABLES
may have up to 100, each for its reason. Of the .cpp files of src and apps nine in ten have at most
250 lines and none more than 500; of web's .ts and .mjs files likewise.

Functions are found in formatted code: a body begins with a line that ends in "{", and ends at the
first "}" indented as the function's first line (C++) or as that line (TypeScript). On the C++ of
this repository that gives the same lengths as Universal Ctags.
"""
import os
import re
import sys
from pathlib import Path

LONGEST, LONGEST_TABLE = 60, 100
FILE_TENTH, FILE_LONGEST = 250, 500

# What may be longer, and why: tables of rows, not of steps.
TABLES = {
    ("python/measures.cpp", "bind_excursions"): "one row per property of the Python classes",
    ("python/simulator.cpp", "bind_simulator"): "one row per method of the Python class",
}

# A line that opens a scope which is no function: its inside is looked at.
SCOPE = re.compile(r"^\s*(inline |export |default |extern \"C\" |template\b.* )*"
                   r"(namespace|class|struct|union|enum|interface)\b")
SUITE = re.compile(r"^\s*(await )?(describe|test|it)\(")  # a test is a list of steps
CONTROL = re.compile(r"^\s*(\} )?(if|else|for|while|switch|do|try|catch|case|default)\b")
NAME = re.compile(r"([A-Za-z_~][\w:~]*|operator[^\s(]*)\s*(?:<[^()]*>)?\(")


def files(folder, pattern, roots):
    """Paths below the folder, those of packages and of what is built excepted."""
    out = []
    for root in roots:
        for path, folders, names in os.walk(Path(folder) / root):
            folders[:] = [f for f in folders if f not in ("node_modules", "dist")]
            out += [os.path.relpath(os.path.join(path, name), folder) for name in names if re.search(pattern, name)]
    return sorted(out)


def without_strings(lines):
    """Lines of C++ without raw strings, whose text is no code."""
    text = re.sub(r'R"(\w*)\((.*?)\)\1"', lambda m: '""' + "\n" * m.group(2).count("\n"), "\n".join(lines), flags=re.S)
    return text.split("\n")


def functions(lines, cpp):
    """(name, first line, count of lines) of each function, the outermost alone."""
    if cpp:
        lines = without_strings(lines)
    at = 0
    while at < len(lines):
        line = lines[at]
        opens = line.rstrip().endswith("{") and not line.lstrip().startswith(("//", "*", "/*", "#"))
        if not opens or SCOPE.match(line) and "(" not in line.split("{")[0].split("=")[0]:
            at += 1
            continue
        # The head may take several lines: back to the one after the last statement or scope.
        first = at
        while first > 0 and not re.search(r"[;{}]\s*(//.*)?$|^\s*(//|#|public:|private:|protected:|\*/)|^\s*$",
                                          lines[first - 1]):
            first -= 1
        head = " ".join(part.strip() for part in lines[first:at + 1])
        head = re.sub(r"^template\s*<[^<>]*>\s*", "", head)
        if SCOPE.match(head) or SUITE.match(head) or "(" not in head or CONTROL.match(head):
            at += 1
            continue
        indent = re.match(r"\s*", lines[first if cpp else at]).group()
        end = next((i for i in range(at + 1, len(lines)) if re.match(re.escape(indent) + r"\}", lines[i])), None)
        if end is None:
            at += 1
            continue
        name = NAME.search(head)
        yield (name.group(1) if name else head[:40], first + 1, end - first + 1)
        at = end + 1


def long_files(counts):
    """Sentences about the lengths of one kind of file."""
    said = [f"{f}: {n} lines; a file has at most {FILE_LONGEST}" for f, n in counts.items() if n > FILE_LONGEST]
    tenth = sorted(counts.values())[int(0.9 * (len(counts) - 1))] if counts else 0
    if tenth > FILE_TENTH:
        said.append(f"one file in ten has over {tenth} lines, and {FILE_TENTH} are the limit: the longest are " +
                    ", ".join(f"{f} ({n})" for f, n in sorted(counts.items(), key=lambda c: -c[1])[:10]))
    return said


def main(folder, listing):
    said, found, seen = [], [], set()
    for pattern, roots in ((r"\.cpp$", ["src", "apps"]), (r"\.(ts|mjs)$", ["web"])):
        counts = {}
        for f in files(folder, pattern, roots):
            counts[f] = len((Path(folder) / f).read_text().splitlines())
        said += long_files(counts)
        found += [(n, f, 1, "") for f, n in counts.items()] if listing else []
    for f in files(folder, r"\.(cpp|hpp|ts|mjs)$", ["src", "apps", "python", "web"]):
        for name, first, count in functions((Path(folder) / f).read_text().splitlines(), f.endswith("pp")):
            most = LONGEST_TABLE if (f, name) in TABLES else LONGEST
            if count > LONGEST:
                seen.add((f, name))
            if count > most:
                said.append(f"{f}:{first}: {name} has {count} lines; a function has at most {most}")
            if listing:
                found.append((count, f, first, name))
    said += [f"{f}: {name} is among the tables of {Path(__file__).name} and need not be" for f, name in TABLES
             if (f, name) not in seen and (Path(folder) / f).exists()]
    if listing:
        for count, f, first, name in sorted(found, reverse=True)[:60]:
            print(f"{count:5} {f}:{first} {name}")
        return 0
    print("\n".join(said))
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--list" in sys.argv[2:]))
