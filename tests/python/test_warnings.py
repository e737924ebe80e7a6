# SPDX-License-Identifier: GPL-3.0-or-later
"""Python shows every warning: tests/support/noted_scenes.cpp has a scene for each."""
import os
import pathlib
import tempfile
import unittest

import hyperex

FOLDERS = sorted(folder for folder in pathlib.Path(os.environ["HYPEREX_NOTED_SCENES"]).iterdir()
                 if (folder / "scene.toml").exists())  # without videos one is missing


def remark(remarks, id):
    return next((one for one in remarks if one["id"] == id), None)


class Warnings(unittest.TestCase):
    def test_are_shown(self):
        self.assertGreater(len(FOLDERS), 14)
        for folder in FOLDERS:
            if folder.name == "recording.mirror_unknown":
                continue  # the library of videos lies beside the program, not beside the module
            with self.subTest(folder.name), tempfile.TemporaryDirectory() as out:
                file = folder / "scene.toml"
                checked = hyperex.check_scene(file)
                found = remark(checked["remarks"], folder.name)
                if found is None:
                    summary = hyperex.run_scene(file, pathlib.Path(out) / "out")
                    found = remark(summary["remarks"], folder.name)
                    self.assertIsNotNone(found, summary["remarks"])
                    self.assertIn(found["text"], summary["warnings"])
                else:
                    self.assertIn(found["text"], checked["warnings"])
                self.assertEqual(found["severity"], "warning")

    def test_are_those_of_a_scene(self):
        folder = next(one for one in FOLDERS if one.name == "sides.exchanged_pair")
        scene = hyperex.Scene(folder / "scene.toml")
        checked = hyperex.check_scene(folder / "scene.toml")
        self.assertIn(remark(checked["remarks"], folder.name)["text"], scene.warnings)
