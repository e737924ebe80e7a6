#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does what a page of docs/ says: runs its fenced blocks in order, in a folder of their own.

    run_page.py PAGE --bin FOLDER [--module FOLDER] [--keep FOLDER] [--pictures]

What is behind the language of a block says what is done with it; blocks without are not touched:

    ```sh run              runs it by bash, which ends at the first error
    ```python run          runs it by python3
    ```python file=a.py    writes it into the file
    ```toml file=a.toml
    ```text printed        what the last block that ran prints: each line must be in its output, in this order; numbers
                           may differ by 2 % or 0.02 (processors round differently), and ... stands for anything
    ```text printed within=10   the same; numbers may differ by 10 % (a tracking network magnifies such differences)
    ... needs=blender      only where there is this program; without it the block is skipped, and those that need it

The folder holds a link `examples` to those of the repository. FOLDER of --bin is put into PATH, that of --module into
PYTHONPATH. Every picture of the page below images/tutorials must have been written, under its name (a .webp may be
written as .png); --pictures takes it over into the page's folder, by python3-pil where the format changes. Ends with 1 where something fails, with 77 where all went well but a program was
missing.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
SKIPPED = 77
WIDEST_PX = 1100


def blocks(text):
    """(line, language, marks, content) of the fenced blocks."""
    lines = text.splitlines()
    at = 0
    while at < len(lines):
        opened = re.match(r"(```+)(\S*)\s*(.*)$", lines[at])
        if not opened:
            at += 1
            continue
        end = next(k for k in range(at + 1, len(lines)) if lines[k].startswith(opened.group(1)))
        yield at + 1, opened.group(2), opened.group(3).split(), "\n".join(lines[at + 1:end]) + "\n"
        at = end + 1


def alike(expected, line, percent):
    """A line of the output is the expected one, numbers within what processors may differ by."""
    words = [re.escape(part) for part in NUMBER.sub("\0", expected).replace("...", "\1").split("\0")]
    pattern = f"({NUMBER.pattern})".join(words).replace(re.escape("\1"), ".*").replace("\1", ".*")
    pattern = re.sub(r"(\\ )+", r"\\s+", pattern)
    found = re.fullmatch(r"\s*" + pattern + r"\s*", line)
    if not found:
        return False
    return all(abs(float(a) - float(b)) <= max(0.02, percent / 100 * abs(float(a)))
               for a, b in zip(NUMBER.findall(expected), found.groups()))


def check_printed(place, expected, output, percent):
    rest = output.splitlines()
    for wanted in expected.splitlines():
        if wanted.strip() in ("", "..."):
            continue
        at = next((k for k, line in enumerate(rest) if alike(wanted.strip(), line.strip(), percent)), None)
        if at is None:
            sys.exit(f"{place}: not printed (in this order): {wanted}\n--- printed was:\n{output}")
        rest = rest[at + 1:]


def take_over(picture, target):
    if picture.suffix == target.suffix:
        shutil.copyfile(picture, target)
        return
    from PIL import Image
    image = Image.open(picture).convert("RGB")
    image.thumbnail((WIDEST_PX, WIDEST_PX))
    image.save(target, quality=80, method=6)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path)
    parser.add_argument("--bin", type=Path, required=True)
    parser.add_argument("--module", type=Path)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--pictures", action="store_true")
    options = parser.parse_args()
    page = options.page.resolve()
    text = page.read_text(encoding="utf-8")
    own = tempfile.TemporaryDirectory() if not options.keep else None
    folder = Path(own.name) if own else options.keep.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / "examples").exists():
        (folder / "examples").symlink_to(ROOT / "examples")
    tools = tempfile.TemporaryDirectory()  # python3 is the one that runs this, for which the module is
    (Path(tools.name) / "python3").symlink_to(sys.executable)
    path = f"{tools.name}:{options.bin.resolve()}:{os.environ['PATH']}"
    environment = dict(os.environ, PATH=path, MPLBACKEND="Agg",
                       PYTHONDONTWRITEBYTECODE="1", QT_QPA_PLATFORM="offscreen", LC_ALL="C.UTF-8")
    environment.setdefault("XDG_CACHE_HOME", str(folder / "cache"))
    if options.module:
        environment["PYTHONPATH"] = str(options.module.resolve())
    ran, missing, output = 0, set(), ""
    for line, language, marks, content in blocks(text):
        place = f"{page.name}:{line}"
        file = next((mark[5:] for mark in marks if mark.startswith("file=")), None)
        lacking = {mark[6:] for mark in marks if mark.startswith("needs=") and not shutil.which(mark[6:])}
        if lacking:
            missing |= lacking
            output = None
            print(f"{place}: skipped, there is no {', '.join(sorted(lacking))}", flush=True)
        elif file:
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_text(content, encoding="utf-8")
        elif "run" in marks:
            command = {"sh": ["bash", "-euo", "pipefail", "-c", content],
                       "python": [sys.executable, "-c", content]}[language]
            began = time.monotonic()
            done = subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, errors="replace")
            if done.returncode:
                sys.exit(f"{place}: ended with {done.returncode}\n{done.stdout}")
            output = done.stdout
            ran += 1
            print(f"{place}: {time.monotonic() - began:.1f} s", flush=True)
        elif "printed" in marks and output is not None:
            within = next((float(mark[7:]) for mark in marks if mark.startswith("within=")), 2)
            check_printed(place, content, output, within)
    if not ran:
        sys.exit(f"{page.name}: nothing to run")
    for target in re.findall(r"!\[[^\]]*\]\(([^)]*images/tutorials/[^)]*)\)", text):
        picture = folder / Path(target).name
        if not picture.exists():
            picture = picture.with_suffix(".png")
        if not picture.exists():
            if not missing:
                sys.exit(f"{page.name}: no block has written {Path(target).name}")
        elif options.pictures:
            take_over(picture, page.parent / target)
            print(f"{target}: {(page.parent / target).stat().st_size / 1e3:.0f} kB")
    print(f"{page.name}: {ran} blocks ran" + (f"; without {', '.join(sorted(missing))}" if missing else ""))
    sys.exit(SKIPPED if missing else 0)


if __name__ == "__main__":
    main()
