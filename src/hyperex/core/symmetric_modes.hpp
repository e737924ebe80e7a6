// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

namespace hyperex {

/// A = vectors * diag(values) * vectors^T of a symmetric matrix.
struct SymmetricModes {
  Eigen::VectorXd values;   ///< rising
  Eigen::MatrixXd vectors;  ///< columns, orthonormal
};

/// Reads the lower triangle. Here, so that the solver's templates are compiled once.
SymmetricModes symmetric_modes(const Eigen::MatrixXd& a);

}  // namespace hyperex
