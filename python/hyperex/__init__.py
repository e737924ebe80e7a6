# SPDX-License-Identifier: GPL-3.0-or-later
"""Recorded expressions re-enacted on scanned faces through simulated soft tissue.

SI units inside, units in names: `young_pa`, `step_s`, `excursion_mm`. What the library has to say
besides results goes to the logger "hyperex" of Python's logging.
"""
from . import _hyperex
from ._hyperex import __version__

__all__ = sorted(name for name in vars(_hyperex) if not name.startswith("_"))
for _name in __all__:
    globals()[_name] = getattr(_hyperex, _name)
    globals()[_name].__module__ = "hyperex"
del _name
