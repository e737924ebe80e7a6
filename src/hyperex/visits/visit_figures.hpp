// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex::visits {

/// "3.7": one decimal, rounded once, from the exact value. What rounds to nothing is "0.0".
std::string figure(double value);

/// "+3.7": a figure with its sign; what rounds to nothing has none.
std::string signed_figure(double value);

}  // namespace hyperex::visits
