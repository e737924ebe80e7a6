// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>

namespace hyperex::metrics {

/// The value of a figure that cannot be computed from the data.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace hyperex::metrics
