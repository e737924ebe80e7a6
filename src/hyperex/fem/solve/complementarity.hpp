// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

namespace hyperex::fem {

/// Report on the solution of a linear complementarity problem.
struct Complementarity {
  int sweeps = 0;
  /// Greatest |min(w_i, a_ii z_i)| in the unit of w: how far any pair is from satisfying w >= 0,
  /// z >= 0 and w_i z_i = 0. At an exact solution it is 0.
  double residual = 0;
};

/// Finds z >= 0 with w = q + A z >= 0 and w_i z_i = 0, starting from the given `z`. Two methods are
/// combined: projected Gauss-Seidel (Cryer, SIAM J. Control 9, 1971, 385) and the primal-dual
/// active set method (Hintermueller, Ito and Kunisch, SIAM J. Optim. 13, 2003, 865). A: n x n,
/// symmetric, positive semidefinite with positive diagonal. Ends when the residual is at most
/// `tolerance` (unit of w), or after `most_sweeps` Gauss-Seidel sweeps. Successive sweeps run in
/// opposite directions. At the start and after every tenth sweep, the active set method is tried
/// with dense factors; its result is kept if it has a smaller residual. A sweep allocates nothing.
Complementarity solve_complementarity(const Eigen::MatrixXd& a, const Eigen::VectorXd& q,
                                      double tolerance, int most_sweeps, Eigen::VectorXd& z);

}  // namespace hyperex::fem
