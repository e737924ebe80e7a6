// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/motion/rigid_set.hpp"

namespace hyperex::motion {

/// The point of chi-square that a draw in a thousand exceeds, divided by the degrees of freedom (>
/// 0; Wilson and Hilferty, PNAS 17 (1931) 684).
double rare_chi_square(double freedom);

/// Means over `width` (1 to N) samples about each of N; at the ends the window lies within.
Eigen::MatrixXd window_means(const Eigen::MatrixXd& values, std::size_t width);

/// How a point moves against a set.
struct Against {
  double share = 0;    ///< its residual divided by the bound of give and jitter; above 1: it moves
  double moves_m = 0;  ///< farthest from the first sample, in means of the shortest window
  /// By how much the mean square of all residuals falls where the point leaves the set.
  double relief_m2 = 0;
};

/// All P points against a set of three or more (rising), as largest_rigid_set() judges them: the
/// greatest share and movement of the recordings.
std::vector<Against> all_against(const std::vector<TrackedPoints>& recordings,
                                 const std::vector<Eigen::Index>& set, double give_m);

}  // namespace hyperex::motion
