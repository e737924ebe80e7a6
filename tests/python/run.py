# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one file of tests: run.py test_simulator. Ends with 77 where a test was skipped."""
import sys
import unittest

result = unittest.main(module=sys.argv[1], argv=sys.argv[:1] + sys.argv[2:], exit=False,
                       verbosity=2).result
if not result.wasSuccessful() or result.testsRun == 0:
    sys.exit(1)
sys.exit(77 if result.skipped else 0)
