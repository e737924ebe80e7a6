# SPDX-License-Identifier: GPL-3.0-or-later
import json
import pathlib
import tempfile
import unittest

import numpy as np

import hyperex


class Estimate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.scene = pathlib.Path(self.folder.name) / "s.toml"
        self.scene.write_text(
            'scan = { file = "embedded" }\nmotion = { file = "embedded" }\n'
            "mesh = { element_size_mm = 9 }\n"
            'drive.points = ["ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57", "ibug68_8"]\n')

    def tearDown(self):
        self.folder.cleanup()

    def test_findings_have_intervals(self):
        estimate = hyperex.estimate(self.scene, stiffness=["cheek_L:cheek_R"], gains=["zygomatic_R"])
        ratio, gain = estimate.findings
        self.assertEqual((ratio.kind, ratio.name), ("ratio", "cheek_L / cheek_R"))
        self.assertLess(ratio.interval[0], 1)
        self.assertGreater(ratio.interval[1], 1)
        self.assertEqual(gain.kind, "gain")
        self.assertFalse(gain.determined)  # an opening mouth does not use it
        self.assertIn("cannot tell", estimate.summary[1])
        self.assertEqual(json.loads(estimate.json())["points"], estimate.points)

    def test_a_known_load_gives_the_stiffness_of_the_tissue(self):
        lying = pathlib.Path(self.folder.name) / "lying.csv"
        names = sorted(hyperex.embedded_face().landmarks)
        rest = np.array([hyperex.embedded_face().landmarks[name] for name in names])
        lower = [name in {f"ibug68_{number}" for number in range(48, 68)} for name in names]
        hyperex.write_motion_csv(lying, hyperex.Motion(names, [0, 1], [rest, rest - np.outer(lower, [0, 0, 0.0015])]))
        estimate = hyperex.estimate(self.scene, lying=lying)
        young, = estimate.findings
        self.assertEqual((young.kind, young.name), ("young_kpa", "soft tissue"))
        self.assertLess(young.interval[0], young.value)
        self.assertIn("kPa", estimate.summary[0])

    def test_a_mistake_is_one_sentence(self):
        with self.assertRaisesRegex(ValueError, "Motion alone"):
            hyperex.estimate(self.scene, stiffness=["all"])
        with self.assertRaisesRegex(ValueError, "what to find"):
            hyperex.estimate(self.scene)


if __name__ == "__main__":
    unittest.main()
