// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/symmetric_modes.hpp"

#include <Eigen/Eigenvalues>

namespace hyperex {

SymmetricModes symmetric_modes(const Eigen::MatrixXd& a) {
  if (a.rows() == 0) return {Eigen::VectorXd(), a};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace hyperex
