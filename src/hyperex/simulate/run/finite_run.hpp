// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/time/drive.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "hyperex/simulate/load/nodal_course.hpp"
#include "hyperex/simulate/run/solve.hpp"

namespace hyperex::simulate {

/// Loads and prescribed motion of a face at finite strain. Drives are given at steps of `step_s`
/// and are linear between them.
struct FiniteDrive {
  double step_s = 0.002;
  fem::Drive still;    ///< prescribed displacements, and forces that keep their direction
  fem::Drive turning;  ///< forces that turn with the tissue about them; no shapes: none
  std::shared_ptr<const NodalCourse>
      forces;  ///< N, further ones that keep their direction, or null
  /// The face at rest: constant prescribed displacements (m, as `still`) and forces (N, all
  /// unknowns). The run begins in static equilibrium under them. Empty: none.
  Eigen::VectorXd rest_prescribed, rest_force;
  Eigen::VectorXd rest_guess;  ///< of that equilibrium, m; empty: none
  /// Displacements (m) of further prescribed nodes; null: none.
  const NodalCourse* places = nullptr;
};

struct FiniteSolution {
  Solution solution;
  /// Reaction forces (N) on the nodes of `places`. If they are applied instead of the prescribed
  /// displacements, the motion is the same.
  NodalCourse reactions;
  int steps = 0, parts = 0, iterations = 0, factorisations = 0;
};

/// Runs from rest, in steps that end at `step_ends_s` (the first is 0) or in parts of them. The
/// displacements at `times` (in steps of the drive) are cubic between steps. `newton` prescribes
/// the unknowns of `still` and the nodes of `places`. Throws NumericalError as
/// FiniteNewton::step().
FiniteSolution run_finite(fem::FiniteNewton& newton, const fem::Assembler& assembler,
                          const std::vector<int>& still_prescribed, const FiniteDrive& drive,
                          const std::vector<double>& step_ends_s, const std::vector<double>& times,
                          const StepProgress& progress = {});

}  // namespace hyperex::simulate
