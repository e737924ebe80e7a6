// SPDX-License-Identifier: GPL-3.0-or-later
// Private data of FiniteNewton, shared by its source files.
#pragma once
#include <optional>

#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/time/factor_age.hpp"
#include "hyperex/fem/time/factor_turns.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "hyperex/fem/time/secants.hpp"

namespace hyperex::fem {

struct FiniteNewton::Impl {
  FiniteStrain& form;
  FiniteNewtonOptions options;
  SparseMatrix springs;
  std::vector<int> spring_places;  // positions of the spring entries in `matrix`
  std::vector<const NodalPotential*> potentials;
  SparseMatrix matrix;
  std::optional<PartitionedFactor> factor;

  Kinematics state;
  Eigen::VectorXd d_before, v_before;
  double last_h = 0, time = 0;
  Eigen::VectorXd force_last, start_prescribed;

  FactorAge age;
  FactorTurns turns;

  // Data of the current part of a step.
  RateRule rule;
  double mass_share = 0;
  Eigen::VectorXd x, x_hat, gradient, external, residual;  // all unknowns
  Eigen::VectorXd trial, trial_gradient, delta, from_hat, mass_u, prescribed_change, turned_change,
      target, part_force;
  Eigen::VectorXd q, s, y;  // free unknowns
  Secants secants{0};
  double energy_scale = 0, right_side = 0;

  Impl(FiniteStrain& f, std::vector<int> prescribed, const FiniteNewtonOptions& o,
       SparseMatrix given_springs, std::vector<const NodalPotential*> given_potentials,
       std::shared_ptr<const NodeOrder> order);

  // The incremental potential (finite_potential.cpp).
  void place_springs();
  void fill_matrix(const Eigen::VectorXd& d, bool projected);
  bool factor_at(const Eigen::VectorXd& d, FiniteStepReport& report);
  void solve(Eigen::VectorXd& rhs);  // free unknowns
  double potential(const Eigen::VectorXd& d, Eigen::VectorXd& out);

  // Steps (finite_newton.cpp).
  FiniteStepReport advance(double dt, const Eigen::VectorXd& prescribed,
                           const Eigen::VectorXd& force, const FiniteNewtonHooks& hooks,
                           const Eigen::VectorXd* guess);
  void take(double h);
  [[noreturn]] void fail(double h);

  // Iterations of one part of a step (finite_iterations.cpp).
  struct Iterations {
    double energy = 0, first_residual = 0;
    double size = 0, share = 1, last_size = 0;  // of corrections; m
    bool refactor = false, fresh = false;
    bool jumped = false;       // the prescribed unknowns have reached their targets
    bool at_rounding = false;  // corrections with a fresh factor no longer decrease
    int forgiven = 0;
  };
  enum class Move { made, again, converged, failed };
  bool converge(double h, const Eigen::VectorXd* guess, const FiniteNewtonHooks& hooks,
                FiniteStepReport& report);
  void begin(double h, const Eigen::VectorXd* guess);
  void find_residual();
  void turn_factor();
  void find_direction(bool jump);
  Move jump(Iterations& now);
  Move descend(Iterations& now, FiniteStepReport& report);
  void accept_trial(bool jumped);
  double missing_m(Iterations& now, int iteration, double scale);
  double search(double& energy);
  bool residual_is_rounding(double first_residual) const;
};

/// The greatest displacement of a node of `d` (3 |nodes|).
double greatest_motion(const Eigen::VectorXd& d);

}  // namespace hyperex::fem
