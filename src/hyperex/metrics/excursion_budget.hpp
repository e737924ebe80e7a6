// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/metrics/error_budget.hpp"
#include "hyperex/metrics/excursion.hpp"

namespace hyperex::metrics {

/// The error of the difference between both sides, mm^2, by its floors: half the width of its 95 %
/// interval is floor_mm().
ErrorBudget budget_of_difference(const PairExcursion& pair);

/// "jitter", "head pose", "mesh" or "repetition"; empty where no floor is known.
std::string largest_part_of(const PairExcursion& pair);

}  // namespace hyperex::metrics
