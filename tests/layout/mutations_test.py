#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each mutation of tests/mutations/mutations.txt names a file that holds its text exactly once, and tests that exist.

    mutations_test.py REPOSITORY [BUILD_FOLDER]    without a build the names of tests are not checked
"""
import json
import os
import re
import subprocess
import sys

root = sys.argv[1]
tests = None
if len(sys.argv) > 2:
    listed = subprocess.run(["ctest", "--test-dir", sys.argv[2], "--show-only=json-v1"],
                            capture_output=True, text=True, check=True).stdout
    tests = [test["name"] for test in json.loads(listed)["tests"]]
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
        pattern = line.split("|", 5)[5].strip()  # as run.sh reads it
        if tests is not None and not any(re.search(pattern, test) for test in tests):
            wrong.append(f"mutations.txt:{number}: {name}: no test is called {pattern}")
print("\n".join(wrong))
sys.exit(bool(wrong))
