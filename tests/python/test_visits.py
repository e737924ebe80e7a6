# SPDX-License-Identifier: GPL-3.0-or-later
import csv
import pathlib
import tempfile
import unittest

import numpy as np

import hyperex


class Visits(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        landmarks = hyperex.embedded_face().landmarks
        names = [name for name in landmarks if name.startswith("ibug68_")]
        rest = np.array([landmarks[name] for name in names])
        for file, right in (("before.csv", 1.0), ("after.csv", 0.5)):
            with open(self.path / file, "w", newline="") as out:
                table = csv.writer(out)
                table.writerow(["time_s", *[f"{name}_{axis}_mm" for name in names for axis in "xyz"]])
                for k in range(30):
                    at = rest.copy()
                    share = np.sin(np.pi * k / 29)
                    at[names.index("ibug68_48")] += share * right * np.array([-0.006, 0.008, 0])
                    at[names.index("ibug68_54")] += share * np.array([0.006, 0.008, 0])
                    table.writerow([k / 30, *(1e3 * at).ravel()])
        (self.path / "v.toml").write_text(
            '[[visit]]\ndate = 2026-03-01\nrecording = "before.csv"\njitter_mm = 0\n'
            '[[visit]]\ndate = 2026-06-01\nrecording = "after.csv"\njitter_mm = 0\n')

    def tearDown(self):
        self.folder.cleanup()

    def test_changes_have_intervals(self):
        visits = hyperex.compare_visits(self.path / "v.toml")
        self.assertEqual(visits.labels, ["2026-03-01", "2026-06-01"])
        right = visits["corner_excursion", "R"]
        self.assertEqual((right.side, right.unit), ("R", "mm"))
        self.assertIsNone(right.changes[0])
        change = right.changes[1]
        self.assertAlmostEqual(change.value, -5, delta=0.3)
        self.assertLess(change.interval[0], change.measured[0])
        self.assertEqual(change.beyond, "yes")
        self.assertEqual(visits["corner_excursion", "L"].changes[1].beyond, "no")
        self.assertIn("Right corner of the mouth", visits.summary[0])
        with self.assertRaises(KeyError):
            visits["corner_excursion", "both"]

    def test_page_and_table(self):
        visits = hyperex.compare_visits(self.path / "v.toml")
        visits.write_page(self.path / "v.html")
        visits.write_table(self.path / "v.csv")
        self.assertIn("Hyperex visits", (self.path / "v.html").read_text())
        with open(self.path / "v.csv") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 2 * len(visits.measures))

    def test_a_mistake_is_one_sentence(self):
        (self.path / "v.toml").write_text('[[visit]]\ndate = 2026-03-01\nrecording = "none.csv"\n')
        with self.assertRaisesRegex(hyperex.InputError, "an existing file"):
            hyperex.compare_visits(self.path / "v.toml")


if __name__ == "__main__":
    unittest.main()
