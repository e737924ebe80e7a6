// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace hyperex {

/// Runs all at the same time and returns when all have ended. Then the first exception among them,
/// if any, is thrown again. Unlike with tbb::parallel_invoke, an exception in one does not cancel
/// the others: a cancelled parallel loop returns as if it were done, and the code after it would
/// use results that were never computed.
void run_together(const std::vector<std::function<void()>>& all);

/// The same for body(0) to body(count - 1), as a parallel loop: those that have begun when another
/// throws are run to their end, those that have not are left out.
void run_each(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace hyperex
