// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/visits/compare_visits.hpp"

namespace hyperex::visits {

/// "3.7": rounded once, from the exact value. What rounds to nothing is "0.0".
std::string figure(double value, int digits = 1);

/// "+3.7": a figure with its sign; what rounds to nothing has none.
std::string signed_figure(double value, int digits = 1);

/// Decimals of a change and its interval: 1, but 2 where a bound would print as 0 beside a change
/// that is beyond.
int digits_of(const Change& change);

}  // namespace hyperex::visits
