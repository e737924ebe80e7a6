// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

namespace hyperex::fem {

/// How a linear complementarity problem was solved.
struct Complementarity {
  int sweeps = 0;
  /// Greatest |min(w_i, a_ii z_i)|, in the unit of w: how far any pair is from either w = 0 or z =
  /// 0.
  double residual = 0;
};

/// Finds z >= 0 with w = q + A z >= 0 and w_i z_i = 0 by projected Gauss-Seidel (Cryer, SIAM J.
/// Control 9, 1971, 385) and the primal-dual active set method (Hintermueller, Ito and Kunisch,
/// SIAM J. Optim. 13, 2003, 865), begun at the `z` given. A: n x n, symmetric, positive
/// semidefinite with positive diagonal. Ends where the residual is at most `tolerance` (unit of w),
/// or after `most_sweeps`. The order of sweeps alternates; at first and after every tenth the
/// active set is looked for, by dense factors, and its answer kept where it is nearer. Nothing is
/// allocated in a sweep.
Complementarity solve_complementarity(const Eigen::MatrixXd& a, const Eigen::VectorXd& q,
                                      double tolerance, int most_sweeps, Eigen::VectorXd& z);

}  // namespace hyperex::fem
