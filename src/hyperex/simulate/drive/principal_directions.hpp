// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

namespace hyperex::simulate {

/// The left singular vectors of a matrix and its singular values, largest first.
struct PrincipalDirections {
  Eigen::MatrixXd directions;  ///< rows x min(rows, columns), orthonormal
  Eigen::VectorXd sizes;       ///< the singular value of each direction
};

/// By the eigenvectors of the smaller of A A^T and A^T A. Singular values below 1e-7 of the largest
/// are not resolved, and their directions are arbitrary.
PrincipalDirections principal_directions(const Eigen::MatrixXd& a);

}  // namespace hyperex::simulate
