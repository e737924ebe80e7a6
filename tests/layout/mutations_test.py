#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each mutation of tests/mutations/mutations.txt names a file that holds its text exactly once: mutations_test.py REPOSITORY"""
import os
import sys

root = sys.argv[1]
wrong = []
with open(os.path.join(root, "tests/mutations/mutations.txt")) as lines:
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.startswith("#"):
            continue
        name, file, text = (cell.strip() for cell in line.split(" | ")[:3])
        try:
            with open(os.path.join(root, file)) as source:
                count = source.read().count(text)
        except OSError:
            count = 0
        if count != 1:
            wrong.append(f"mutations.txt:{number}: {name}: {file} holds {text!r} {count} times, expected once")
print("\n".join(wrong))
sys.exit(bool(wrong))
