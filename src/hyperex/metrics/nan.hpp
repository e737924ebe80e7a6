// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>

namespace hyperex::metrics {

/// For a figure that these data do not give.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace hyperex::metrics
