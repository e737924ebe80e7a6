#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times `hyperex run` as a user meets it: the command itself, all of its outputs, on real files.

whole_run.py PROGRAM RESULT.json [--quick]

Subject A's mouth opening where the data set lies beside the checkout, else the demo. Each case is run
three times (once with --quick), each time into a new folder; "first" begins with an empty cache
folder, "again" finds what the first run kept there. Thirty variants (six with --quick) are run once
each way, and compared with one run that is driven alike.
"""
import json
import os
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCAN = ROOT / "../shared/data/ict/subject_A_neutral_scan.ply"
SCENE = ROOT / ("bench/scenes/subject_a_mouth_open.toml" if SCAN.exists()
                else "examples/mouth_open.toml")


def run(program, scene, folder, options, cache):
    """Wall and processor seconds of one run, and what its summary says."""
    out = folder / "out"
    shutil.rmtree(out, ignore_errors=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    subprocess.run([program, "run", scene, "--out", out, *options], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env={**os.environ, "XDG_CACHE_HOME": str(cache)})
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = json.loads((out / "summary.json").read_text())
    files = sum(f.stat().st_size for f in out.rglob("*") if f.is_file())
    return {"wall_s": wall,
            "processor_s": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            "bytes": files, "stages_s": summary["seconds"]}


def case(program, scene, folder, options, repeats, keep):
    """The median run by wall time; `keep`: of runs after one that has filled the cache."""
    runs = []
    for _ in range(repeats + keep):
        cache = folder / "cache"
        if not keep:
            shutil.rmtree(cache, ignore_errors=True)
        runs.append(run(program, scene, folder, options, cache))
    runs = sorted(runs[keep:], key=lambda one: one["wall_s"])
    middle = runs[len(runs) // 2]
    return {**middle, "runs": len(runs), "spread_s": runs[-1]["wall_s"] - runs[0]["wall_s"],
            "processor_s": statistics.median(one["processor_s"] for one in runs)}


def with_variants(folder, count):
    """The scene with variants from half to twice its stiffness, beside a scene file of the same paths."""
    text = SCENE.read_text()
    # Paths of a scene file are relative to it.
    text = re.sub(r'"((?:\.\./)+[^"]*)"', lambda m: f'"{(SCENE.parent / m[1]).resolve()}"', text)
    for i in range(count):
        kpa = 100 * 2 ** (2 * i / (count - 1) - 1)
        text += f'\n[[variant]]\nname = "young {kpa:.0f} kPa"\ntissue.young_kpa = {kpa:.3f}\n'
    scene = folder / "variants.toml"
    scene.write_text(text)
    return scene


def main():
    program, result = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    quick = "--quick" in sys.argv[3:]
    repeats, variants = (1, 6) if quick else (3, 30)
    no_frames = ["--set", "output.vtu=false"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        found = {
            "scene": str(SCENE.relative_to(ROOT)),
            "first": case(program, SCENE, folder, [], repeats, False),
            "again": case(program, SCENE, folder, [], repeats, True),
            "first_no_frames": case(program, SCENE, folder, no_frames, repeats, False),
            "again_no_frames": case(program, SCENE, folder, no_frames, repeats, True),
        }
        # What drives a scene may depend on whether it has variants: the same run is compared.
        scene = with_variants(folder, variants)
        for by in ("muscles", "displacement"):
            driven = ["--set", f"drive.by={by}"]
            found[f"variants_{by}"] = {
                "count": variants,
                "one": case(program, SCENE, folder, driven, repeats, False),
                "one_again": case(program, SCENE, folder, driven, repeats, True),
                "all": case(program, scene, folder, driven, 1, False),
                "all_again": case(program, scene, folder, driven, 1, True)}
    result.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
