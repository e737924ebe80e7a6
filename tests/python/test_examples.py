# SPDX-License-Identifier: GPL-3.0-or-later
import csv
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

from support import DEMO, SOURCE

EXAMPLES = SOURCE / "examples" / "python"


def run(name, *arguments):
    return subprocess.run([sys.executable, EXAMPLES / name, *arguments], check=True,
                          capture_output=True, text=True).stdout


class Examples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_each_has_fewer_than_40_lines(self):
        for example in EXAMPLES.glob("*.py"):
            self.assertLess(len(example.read_text().splitlines()), 40, example)

    def test_each_is_run_here(self):
        tested = {"first_steps.py", "stiffness_sweep.py", "second_scan.py"}
        self.assertEqual({example.name for example in EXAMPLES.glob("*.py")}, tested)

    def test_first_steps_give_the_numbers_of_the_program(self):
        said = run("first_steps.py", self.folder / "face.glb")
        with open(DEMO / "excursions.csv") as file:
            row = next(row for row in csv.DictReader(file) if row["point"] == "cheilion")
        left, right = (float(row[f"excursion_{side}_mm"]) for side in "LR")
        self.assertIn(f"corners of the mouth: left {left:.2f} mm, right {right:.2f} mm", said)
        self.assertEqual((self.folder / "face.glb").read_bytes()[:4], b"glTF")

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_stiffness_sweep(self):
        said = run("stiffness_sweep.py", self.folder / "sweep.png")
        left = [float(line.split()[3]) for line in said.splitlines()]
        self.assertEqual(len(left), 7)
        self.assertEqual(len(set(left)), 7)
        self.assertEqual((self.folder / "sweep.png").read_bytes()[1:4], b"PNG")

    def test_second_scan(self):
        rows = {line.split()[0]: [float(x) for x in line.split()[1:]]
                for line in run("second_scan.py").splitlines()[1:]}
        distance, still = rows["face"]
        self.assertGreater(distance, 0.001)
        self.assertLess(distance, 0.5 * still)


if __name__ == "__main__":
    unittest.main()
