# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs an example as its comment says, coarsely: run_example.py PROGRAM EXAMPLES WORK NAME

WORK gets a copy of the examples and, with --prepare in the place of NAME, the data that
`hyperex sample` makes. --full: with the scene's own mesh and all outputs.
"""
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys

program, examples, work, name = sys.argv[1], *map(pathlib.Path, sys.argv[2:4]), sys.argv[4]
full = "--full" in sys.argv[5:]

# A coarse mesh, a quarter of the time, the figures alone.
SHORT = ["mesh.element_size_mm=8", "output.vtu=false", "output.glb=false", "output.report=false",
         "output.picture_times_s=[0]"]
# The time of a scene that says its own, and of a recording, which is tracked as it is.
END_S = {"recorded_smile": 0.8}


def call(*arguments):
    print("hyperex", *arguments, flush=True)
    subprocess.run([program, *map(str, arguments)], check=True, cwd=work)


def check(holds, what):
    if not holds:
        sys.exit(f"{name}: {what}")


def finite(value, path="summary"):
    """Every number in a tree; Python's JSON reads NaN and Infinity, which a summary must not hold."""
    if isinstance(value, dict):
        for key, part in value.items():
            finite(part, f"{path}.{key}")
    elif isinstance(value, list):
        for k, part in enumerate(value):
            finite(part, f"{path}[{k}]")
    elif isinstance(value, float):
        check(math.isfinite(value), f"{path} is {value}")


def run_study(file):
    call("sweep", file, "--out", "out/study")
    with open(work / "out/study/study.csv") as table:
        rows = list(csv.DictReader(table))
    check(len(rows) == 4, f"expected four cases; found {len(rows)}")
    for row in rows:
        check(float(row["max_displacement_mm"]) > 1, f"nothing moves in {row}")


def run_visits(file):
    """Its recordings are the demo's motions."""
    call("run", "examples/demo.toml", "--out", "out/demo",
         *[word for one in SHORT for word in ("--set", one)])
    call("visits", file, "--out", "out/visits.html", "--table", "out/visits.csv")
    with open(work / "out/visits.csv") as table:
        rows = {(row["visit"], row["measure"], row["side"]): row for row in csv.DictReader(table)}
    right = rows["2026-06-01", "corner_excursion", "R"]
    left = rows["2026-06-01", "corner_excursion", "L"]
    check(float(right["change"]) < -1, f"the right corner changes by {right['change']} mm")
    check(right["beyond"] == "yes", f"beyond repetition: {right['beyond']}")
    check(left["beyond"] == "no", f"the left corner's change counts as {left['beyond']}")


def run_scene(file):
    call("check", file)
    settings = [] if full else SHORT
    if not full:
        text = (work / file).read_text()
        settings = [*SHORT, "motion.time_scale=0.5"] if "recording" not in text else list(SHORT)
        if "end_s" in text:
            settings.append(f"time.end_s={END_S.get(name, 0.7)}")
    out = pathlib.Path("out") / name
    call("run", file, "--out", out, *[word for one in settings for word in ("--set", one)])
    summary = json.loads((work / out / "summary.json").read_text())
    finite(summary)
    for key in ("frames", "skin_vertices"):
        check(summary[key] > 1, f"{key} is {summary[key]}")
    check(1 < summary["max_displacement_mm"] < 60, f"{summary['max_displacement_mm']} mm")
    corners = summary["symmetry"]["commissure"]["excursion_mm"]
    check(max(corners["L"], corners["R"]) > 1, f"the corners of the mouth move by {corners} mm")
    table = summary.get("variants", {}).get("table", [{}])
    check(len(table) - 1 == (work / file).read_text().count("[[variant]]"), "variants are missing")


work.mkdir(parents=True, exist_ok=True)
if name == "--prepare":
    shutil.rmtree(work, ignore_errors=True)
    shutil.copytree(examples, work / "examples")
    call("sample", "out/sample")
else:
    file = pathlib.Path("examples") / f"{name}.toml"
    {"study": run_study, "visits": run_visits}.get(name, run_scene)(file)
