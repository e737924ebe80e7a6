// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/fem/time/newmark.hpp"
#include "hyperex/simulate/options.hpp"

namespace hyperex::simulate {

/// Displacements of all unknowns at given times.
struct Solution {
  Eigen::VectorXd neutral;       ///< the face at rest on moved bones, m; empty: none are moved
  Eigen::MatrixXd displacement;  ///< 3 |nodes| x |times|, m
  int free_dofs = 0, basis_size = 0;
  double estimated_error = -1;  ///< of the reduced model, over the greatest displacement
  double verified_error = -1;  ///< measured against the full model at these times; -1: not measured
  double greatest_displacement_m = 0;  ///< of the reduced model, at the instants that it samples
  bool converged = true;
};

/// Called with the share of the steps that are done, 0 to 1. It may throw, which ends the run.
using StepProgress = std::function<void(double share)>;

/// Runs all steps of the drive, from rest. `times_in_steps`: rising, from 0 to the last step. The
/// displacements are linear between steps.
Solution run_full(fem::Newmark& newmark, const fem::Drive& drive,
                  const std::vector<double>& times_in_steps, const StepProgress& progress = {});
/// The same by the reduced model; `response` is one of `model`.
Solution run_reduced(const fem::ReducedModel& model, const fem::Response& response,
                     const std::vector<double>& times_in_steps);

/// What a run says of a reduced model that stopped growing before its estimated error was below
/// `tolerance`: the warning `solver.reduced_not_converged`, or the note
/// `solver.reduced_error_small` where that error is less than 0.05 mm. Nothing where it converged.
std::optional<Note> note_on_reduced_error(const Solution& solution, double tolerance);

/// The greatest distance between `a` and `truth` of any node (three rows) in any column, over the
/// greatest displacement of any node in `truth`.
double greatest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& truth);

}  // namespace hyperex::simulate
