// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>

namespace hyperex {

/// Rises from 0 at x = 0 to 1 at x = 1 with slope 0 at both, 3 x^2 - 2 x^3; constant beyond.
inline double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace hyperex
