// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex {

/// A normally distributed error is below this many standard deviations in 95 % of all cases.
inline constexpr double kWithin95 = 1.96;

}  // namespace hyperex
