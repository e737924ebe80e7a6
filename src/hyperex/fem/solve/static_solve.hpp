// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// Solves K_oo d_o = f_o - K_oc d_c for any number of right-hand sides. K_oo is factored once.
class StaticSolver {
 public:
  /// `prescribed`: sorted unique unknowns. Throws NumericalError where K_oo is not positive
  /// definite (too few supports).
  StaticSolver(const SparseMatrix& stiffness, std::vector<int> prescribed);
  ~StaticSolver();
  StaticSolver(StaticSolver&&) noexcept;
  /// Returns the displacements of all unknowns. `force` may be empty. Throws InputError naming an
  /// entry that is not a finite number.
  Eigen::VectorXd solve(const Eigen::VectorXd& prescribed_values,
                        const Eigen::VectorXd& force = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
