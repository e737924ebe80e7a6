// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/fem/time/newmark.hpp"

namespace hyperex::fem {

/// Coefficients of the basis at every step, m x (steps + 1): displacement, velocity and
/// acceleration.
struct ReducedMotion {
  Eigen::MatrixXd d, v, a;
};

/// Newmark's method for a small dense system K d + C d' + M d'' = force.col(step), starting from
/// rest with the first acceleration in equilibrium. All matrices are m x m and symmetric; K and M
/// are positive definite, C is positive semidefinite.
ReducedMotion integrate_reduced(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping,
                                const Eigen::MatrixXd& mass, const Eigen::MatrixXd& force,
                                const NewmarkOptions& options);

}  // namespace hyperex::fem
