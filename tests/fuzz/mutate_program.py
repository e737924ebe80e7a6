#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Broken inputs through the whole program: every format that it reads, every command that reads it.

    mutate_program.py --program build/asan_program/bin/hyperex --count 5           five inputs of each format
    mutate_program.py --program ... --count 5 --seed 200 --formats csv,trc others, of two formats
    mutate_program.py --program ... --again glb:17                         one input once more; its files stay

Small sound inputs (program_seeds.py, program_formats.py) are changed (program_mutate.py) and given to the program,
which is best built under sanitizers:

    make mutants

Input N of a format is the same at every call; --seed is the first N. Some sound inputs are made by the program itself,
so that another version of it may have others. --sound changes nothing and lists what is refused all the same: a scan
of two triangles is read, but has no face. An input fails where

* the exit status is none of 0, 1 and 2, a signal ended the program, or a sanitizer reports something;
* it takes more than 60 s of processor time (300 s by the clock);
* it is refused without a line that begins "hyperex: ", or in more than 40 lines, or with a control character;
* it is refused and a file is left, or a hidden file is left in any case, or an input has changed;
* it is taken, and summary.json holds a number that is none.

The studio is started with its server: files are uploaded and opened, requests sent, raw bytes written. It must answer
each within 300 s and end in order. One input is one file or request.

Failures stay in WORK/failed/FORMAT-N with a shell script that repeats the call. The exit status is 1 where there is one.
"""
import argparse
import collections
import json
import os
import random
import re
import resource
import shlex
import shutil
import subprocess
import sys
import time
import zlib
from pathlib import Path

from program_formats import formats
from program_mutate import Mutator
from program_seeds import made_by
from program_studio import Lost, Silent, Studio

HERE = Path(__file__).resolve().parent
CPU_S, WALL_S = 60, 300
REPORT = re.compile(r"(ERROR: \w*Sanitizer|runtime error:|Sanitizer:DEADLYSIGNAL|hard rss limit)[^\n]*")
STUDIO_EACH = 8  # inputs for one studio, whose start takes longest


def environment(work):
    leaks = HERE.parent / "support" / "leaks.supp"
    return {"PATH": "/usr/bin:/bin", "HOME": str(work), "XDG_CACHE_HOME": str(work / "cache"), "LANG": "C.UTF-8",
            "XDG_STATE_HOME": str(work / "state"), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
            "ASAN_OPTIONS": "exitcode=99:hard_rss_limit_mb=6000",
            "UBSAN_OPTIONS": "print_stacktrace=1", "LSAN_OPTIONS": f"suppressions='{leaks}' print_suppressions=0"}


def files_in(folder):
    """Every path below, hidden ones too, with its bytes."""
    found = {}
    for path, folders, names in os.walk(folder):
        for name in names:
            file = os.path.join(path, name)
            with open(file, "rb") as opened:
                found[os.path.relpath(file, folder)] = opened.read()
        for name in folders:
            found[os.path.relpath(os.path.join(path, name), folder) + "/"] = b""
    return found


def put(folder, files):
    for name, data in files.items():
        path = Path(folder, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        if "cache/" in name:  # the program passes over what others may write
            os.chmod(path, 0o600)
            os.chmod(path.parent, 0o700)


def report_in(text):
    found = REPORT.search(text)
    return found[0][:300] if found else ""


def message_fault(text):
    lines = text.rstrip("\n").split("\n")
    said = [line for line in lines if line.startswith("hyperex: ")]
    if not said:
        return "no line begins with hyperex: "
    if len(lines) > 40:
        return f"{len(lines)} lines of errors"
    if any(len(line) > 1100 for line in said):
        return "a line of over 1100 characters"
    if re.search(r"[\x00-\x08\x0b-\x1f\x7f]", "\n".join(said)):
        return "a control character in a message"
    return ""


def number_fault(folder):
    """summary.json of a finished run is sound JSON of finite numbers."""
    file = Path(folder, "out", "summary.json")
    if not file.exists():
        return ""

    def refuse(what):
        raise ValueError(what)
    try:
        json.loads(file.read_text(), parse_constant=refuse)
    except ValueError as error:
        return f"summary.json: {error}"
    return ""


class Runner:
    def __init__(self, options):
        self.work = Path(options.work).resolve()
        self.program = str(Path(options.program).resolve())
        self.work.mkdir(parents=True, exist_ok=True)
        (self.work / "failed").mkdir(exist_ok=True)
        self.environment = environment(self.work)
        made = self.work / "made"
        maker = {**self.environment, "XDG_CACHE_HOME": str(made / "cache")}
        self.formats = formats(made_by(self.program, str(made), maker))
        self.keep, self.sound = bool(options.again), options.sound
        self.statuses, self.counts = collections.Counter(), collections.Counter()
        self.failures, self.longest = [], (0, "")

    def random_of(self, name, number):
        return random.Random(zlib.crc32(name.encode()) * 1000003 + number)

    def input_of(self, kind, number):
        """The bytes and the call."""
        dice = self.random_of(kind.name, number)
        seed, call = dice.choice(kind.seeds), dice.choice(kind.calls)
        return seed if self.sound else Mutator(dice).mutated(seed, kind.seeds), call

    def fail(self, kind, number, why, folder, text, line=""):
        self.failures.append((kind.name, number, why))
        print(f"FAILED {kind.name}:{number}: {why}", flush=True)
        to = self.work / "failed" / f"{kind.name}-{number}"
        shutil.rmtree(to, ignore_errors=True)
        shutil.copytree(folder, to, symlinks=True)
        (to / "stderr.txt").write_text(text)
        (to / "again.sh").write_text(f"#!/bin/sh\ncd '{to}' && {line or self.program}\n")

    def one(self, kind, number):
        if kind.name.startswith("studio_"):
            return self.studio(kind, number)
        data, call = self.input_of(kind, number)
        folder = self.work / "case"
        shutil.rmtree(folder, ignore_errors=True)
        put(folder, {**kind.beside, kind.file: data})
        before = files_in(folder)
        own = {**self.environment, "XDG_CACHE_HOME": str(folder / "cache")} if kind.name.startswith("kept") \
            else self.environment
        if kind.name == "ct_zip":  # what is unpacked must not stay
            own = {**own, "TMPDIR": str(folder / "tmp")}
        start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        try:
            done = subprocess.run([self.program, *call], cwd=folder, env=own, stdin=subprocess.DEVNULL,
                                  capture_output=True, timeout=WALL_S,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (CPU_S, CPU_S + 5)))
            status, text = done.returncode, done.stderr.decode("utf-8", "replace")
        except subprocess.TimeoutExpired as late:
            status, text = "over 300 s", (late.stderr or b"").decode("utf-8", "replace")
        spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - start
        self.longest = max(self.longest, (spent, f"{kind.name}:{number}"))
        why = self.judged(kind, call, status, text, before, files_in(folder), folder)
        self.statuses[status] += 1
        self.counts[kind.name] += 1
        if self.sound and status != 0:
            why = why or f"sound, but status {status}: {shlex.join(call)[:200]}: {text[-300:]}"
        if why or self.keep:
            self.fail(kind, number, why or f"none: status {status}", folder, text,
                      f"{self.program} {shlex.join(call)}")
        return 1

    def judged(self, kind, call, status, text, before, after, folder):
        if report := report_in(text):
            return report
        if status not in (0, 1, 2):
            return f"status {status}"
        changed = [n for n, data in before.items() if after.get(n) != data and not self.may_change(kind, call, n)]
        if changed:
            return "changed: " + ", ".join(changed)
        new = sorted(set(after) - set(before))
        if hidden := [n for n in new if any(part.startswith(".") for part in n.split("/"))]:
            return "left over: " + ", ".join(hidden)
        if status == 0:
            left = [n for n in new if n.startswith("tmp/")]
            return "left over: " + ", ".join(left) if left else number_fault(folder) if call[0] in ("run", "ct") else ""
        left = [n for n in new if not n.startswith("cache/")]
        if left and call[0] != "sweep":
            return f"status {status}, yet left: " + ", ".join(left[:9])
        return message_fault(text)

    @staticmethod
    def may_change(kind, call, name):
        """Outputs of an earlier run may be replaced, and what was computed before is renewed."""
        return name.startswith("cache/") or kind.name.startswith("run_") and call[0] == "run" and name.startswith("out/")

    def studio(self, kind, number):
        folder = self.work / "case"
        shutil.rmtree(folder, ignore_errors=True)
        scene = b'scan = { file = "face.ply", landmarks = "l.json" }\nmotion = { file = "motion.csv" }\n' \
                b'[mesh]\nelement_size_mm = 14\nlayers = 1\n[time]\nend_s = 0.05\nstep_s = 0.025\nframe_rate_hz = 40\n'
        put(folder, {**kind.beside, "motion.csv": kind.beside["in.csv"], "base.toml": scene, "saved/x": b""})
        if kind.calls == ["left"]:
            put(folder / "state/hyperex/studio/abcdefabcdef", {
                **kind.beside, "painted.ply": b"", "scene.toml": self.input_of(kind, number)[0]})
            os.chmod(folder / "state/hyperex/studio", 0o700)
        studio = Studio([self.program, "studio", "base.toml", "--no-browser", "--no-cache", "--save-into", "saved"],
                        {**self.environment, "XDG_STATE_HOME": str(folder / "state")}, folder, WALL_S)
        each = 1 if kind.calls == ["left"] else STUDIO_EACH
        why, last = "", number
        try:
            if not studio.port:
                why = "the studio does not start"
            elif kind.calls != ["raw"]:
                studio.open_socket()
                if "error" in (answer := studio.ask("open", what="started")):
                    why = f"the sound scene is not opened: {answer['error']}"
                if kind.name == "studio_scene":
                    for name in (n for n in kind.beside if "/" not in n):
                        studio.upload(name, kind.beside[name])
            for last in range(number, number + each) if not why else ():
                why = self.asked(studio, kind, last)
                self.counts[kind.name] += 1
                if why:
                    break
        except (Silent, OSError) as error:
            why = f"no answer ({type(error).__name__})"
        except Lost:
            why = "the connection is lost"
        finally:
            served = studio.alive()
            status, text = studio.end()
        if not why and not served:
            why = "the page is not served any more"
        self.statuses[f"studio {status}"] += 1
        why = report_in(text) or why or ("" if status in (0, 130, 143) else f"status {status} of the studio")
        # Unsaved work stays for the next studio, which says so; what is half written does not.
        kept = "Unsaved work is kept" in text or kind.calls == ["left"]
        left = [n for n in files_in(folder / "state") if not n.endswith((".lock", ".in-use")) and
                ("/." in n or n.count("/") > 2 and not kept)]
        if not why and left:
            why = "left over: " + ", ".join(left[:9])
        if why or self.keep:
            self.fail(kind, last, why or "none", folder, text)
        return each

    def asked(self, studio, kind, number):
        """What is wrong with the answer to one input; empty where nothing is."""
        data, _ = self.input_of(kind, number)
        how, answer = kind.calls[0], None
        if how == "left":
            answer = studio.ask("open", what="autosave")
        elif how == "raw":
            studio.raw(data.replace(b"PORT", str(studio.port).encode()).replace(b"TOKEN", studio.token.encode()))
        elif how == "send":
            answer = self.send(studio, data)
        else:
            name = studio.upload(kind.file, data)
            if not name:
                return "" if not data else "the upload was refused"
            fields = {"what": name}
            if kind.name in ("studio_zip", "studio_recording"):
                fields = {"what": "current", "recording": name}
            answer = studio.ask("open", **fields)
            if kind.name == "studio_recording" and "error" not in answer:
                studio.ask("compare_visits", name=f"visits_{number}", expression="smile")
        return f"sound, but {answer['error']}" if self.sound and answer and "error" in answer else ""

    @staticmethod
    def send(studio, data):
        """What is no request may end the connection; a request is answered, if only with an error."""
        try:
            studio.send(data)
            studio.ask("free_name", name="a")
        except Lost:
            studio.open_socket()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/asan_program/bin/hyperex")
    parser.add_argument("--count", type=int, default=5, help="inputs of each format")
    parser.add_argument("--seed", type=int, default=1, help="number of the first")
    parser.add_argument("--formats", default="", help="names with commas; all where none is given")
    parser.add_argument("--work", default="build/mutants", help="a folder for the work and what failed")
    parser.add_argument("--again", default="", help="FORMAT:NUMBER, this one input alone")
    parser.add_argument("--sound", action="store_true", help="change nothing: all inputs must be taken")
    parser.add_argument("--minutes", type=float, default=1e9, help="end after these")
    options = parser.parse_args()
    runner = Runner(options)
    wanted = [n for n in options.formats.split(",") if n] or list(runner.formats)
    first, count = options.seed, options.count
    if options.again:
        name, first = options.again.split(":")
        wanted, first, count = [name], int(first), 1
    end = time.monotonic() + 60 * options.minutes
    # Format by format would leave the last ones out where the time is short.
    number = first
    while number < first + count and time.monotonic() < end:
        for name in wanted:
            studio = name.startswith("studio_") and name != "studio_left"
            if time.monotonic() < end and (not studio or (number - first) % STUDIO_EACH == 0):
                runner.one(runner.formats[name], number)
        number += 1
    for name, done in runner.counts.items():
        print(f"{name:20} {done}")
    print(f"{sum(runner.counts.values())} inputs of {len(runner.counts)} formats, statuses "
          f"{dict(sorted(runner.statuses.items(), key=str))}, longest {runner.longest[0]:.1f} s of "
          f"{runner.longest[1]}, {len(runner.failures)} failures")
    return 1 if runner.failures and not options.again else 0


if __name__ == "__main__":
    sys.exit(main())
