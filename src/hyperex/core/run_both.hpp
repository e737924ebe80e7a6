// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

namespace hyperex {

/// Runs both at the same time and returns when both have ended. What they throw is thrown then:
/// that of `first`, or else that of `second`. Unlike tbb::parallel_invoke an exception in one does
/// not cancel the other: a cancelled parallel loop returns as if it were done, and what follows it
/// would go on with results that were never made.
void run_both(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace hyperex
