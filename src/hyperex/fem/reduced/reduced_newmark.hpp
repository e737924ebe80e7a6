// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/fem/time/newmark.hpp"

namespace hyperex::fem {

/// Courses of the coefficients of a basis, m x (steps + 1).
struct ReducedMotion {
  Eigen::MatrixXd d, v, a;
};

/// Newmark for a small dense system K d + C d' + M d'' = force.col(step), from rest, the first
/// acceleration in equilibrium. Matrices m x m, symmetric positive definite (C: semi-definite).
ReducedMotion integrate_reduced(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping,
                                const Eigen::MatrixXd& mass, const Eigen::MatrixXd& force,
                                const NewmarkOptions& options);

}  // namespace hyperex::fem
