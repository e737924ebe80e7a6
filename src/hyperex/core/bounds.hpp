// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex {

/// Allowed values of an option, in the unit of its name; both ends are allowed.
struct Bounds {
  double least, most;
  constexpr bool holds(double value) const { return value >= least && value <= most; }
};

}  // namespace hyperex
