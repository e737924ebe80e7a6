// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::motion {

// How a point moves from reading to reading. `at`: P positions (m) in each sample. `p`: the row of
// the point. Results are NaN where a reading is missing.

/// The distance between two readings, m.
double way_m(const std::vector<Points>& at, std::size_t a, std::size_t b, Eigen::Index p);

/// From reading k to the middle of those before and after it, m; 1 <= k <= N - 2.
double bend_m(const std::vector<Points>& at, std::size_t k, Eigen::Index p);

/// The median of bend_m over all samples; infinite where it is known in none, so that no bend
/// exceeds it.
double usual_bend_m(const std::vector<Points>& at, Eigen::Index p);

/// The median of bend_m over all samples but k and those beside it, whose bends contain reading k;
/// 0 where it is known in none of them.
double usual_bend_without_m(const std::vector<Points>& at, std::size_t k, Eigen::Index p);

/// The rows of the four points nearest to this one in a sample, nearest first; fewer where fewer
/// are measured, none where the point itself is not.
std::vector<Eigen::Index> points_beside(const Points& at, Eigen::Index p);

}  // namespace hyperex::motion
