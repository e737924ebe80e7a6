// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

namespace hyperex {

/// Runs all at the same time and returns when all have ended. What they throw is thrown then: that
/// of the first that did. Unlike tbb::parallel_invoke an exception in one does not cancel the
/// others: a cancelled parallel loop returns as if it were done, and what follows it would go on
/// with results that were never made.
void run_together(const std::vector<std::function<void()>>& all);

}  // namespace hyperex
