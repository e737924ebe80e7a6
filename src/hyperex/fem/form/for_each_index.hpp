// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Dense>

namespace hyperex::fem {

/// Calls f(0) ... f(count - 1) in parallel, in chunks large enough to be worth a task.
template <typename F>
void for_each_index(Eigen::Index count, F f) {
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, count, 64), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) f(i);
  });
}

}  // namespace hyperex::fem
