// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/fem/time/drive.hpp"
#include "hyperex/reenact/options.hpp"

namespace hyperex::reenact {

/// Displacements of all unknowns at wanted times, with what it took to find them.
struct Solution {
  Eigen::MatrixXd displacement;  ///< 3 |nodes| x |times|, m
  int free_dofs = 0, basis_size = 0;
  fem::LinearSolver linear_solver = fem::LinearSolver::automatic;  ///< the one picked
  double estimated_error = -1;  ///< of the reduced model, over the greatest displacement
  double verified_error = -1;   ///< against the full model, where asked for: over these times
  bool converged = true;
  double analyse_s = 0, factor_s = 0, basis_s = 0, step_s = 0;
};

/// `times_in_steps`: rising, from 0 to the drive's last step; linear between steps.
Solution solve(fem::System system, const std::vector<int>& prescribed, const fem::Drive& drive,
               const std::vector<double>& times_in_steps, const SolverOptions& options,
               double dt_s);

}  // namespace hyperex::reenact
