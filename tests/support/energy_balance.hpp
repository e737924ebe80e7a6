// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The energy balance of a moving body, updated in every step.
#include <functional>

#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"

namespace hyperex::test {

/// stored + kinetic + dissipated = work of the forces + work of the reactions at driven nodes.
/// Energies come from functions of the fields, reactions from the equation of motion. In each step,
/// the work is the mean of the forces at both ends times the step's displacement, and the
/// dissipation is that of the mean velocity. This is exact for average acceleration.
class EnergyBalance {
 public:
  using OfField = std::function<double(const Eigen::VectorXd&)>;

  /// `stored_of(d)`, `kinetic_of(v)` in J; `dissipation_of(v)` in W; `prescribed`: the unknowns on
  /// which reactions act.
  EnergyBalance(const fem::System& system, std::vector<int> prescribed, OfField stored_of,
                OfField kinetic_of, OfField dissipation_of)
      : system_(system),
        prescribed_(std::move(prescribed)),
        stored_of_(std::move(stored_of)),
        kinetic_of_(std::move(kinetic_of)),
        dissipation_of_(std::move(dissipation_of)) {}

  void begin(const fem::Kinematics& state, const Eigen::VectorXd& force) {
    before_ = state;
    force_ = force;
    reaction_ = reaction(state);
    stored = first_stored_ = stored_of_(state.d);
    kinetic = first_kinetic_ = kinetic_of_(state.v);
    dissipated = force_work = reaction_work = most_work = 0;
  }

  void add(const fem::Kinematics& state, const Eigen::VectorXd& force, double dt_s) {
    const Eigen::VectorXd way = state.d - before_.d, next = reaction(state);
    Eigen::VectorXd f = (force_ + force) / 2;
    for (const int c : prescribed_) f[c] = 0;  // included in the reaction
    force_work += way.dot(f);
    reaction_work += way(prescribed_).dot((reaction_ + next) / 2);
    dissipated += dt_s * dissipation_of_((before_.v + state.v) / 2);
    stored = stored_of_(state.d);
    kinetic = kinetic_of_(state.v);
    most_work = std::max(most_work, std::abs(force_work + reaction_work));
    before_ = state;
    force_ = force;
    reaction_ = next;
  }

  /// The error of the balance, J.
  double gap() const {
    return stored - first_stored_ + kinetic - first_kinetic_ + dissipated - force_work -
           reaction_work;
  }

  double stored = 0, kinetic = 0, dissipated = 0, force_work = 0, reaction_work = 0;
  double most_work = 0;  ///< greatest magnitude of the total work since the start

 private:
  /// The reaction on the prescribed unknowns, which includes forces applied to them.
  Eigen::VectorXd reaction(const fem::Kinematics& x) const {
    return Eigen::VectorXd(system_.mass * x.a + system_.damping * x.v +
                           system_.stiffness * x.d)(prescribed_);
  }

  const fem::System& system_;
  std::vector<int> prescribed_;
  OfField stored_of_, kinetic_of_, dissipation_of_;
  fem::Kinematics before_;
  Eigen::VectorXd force_, reaction_;
  double first_stored_ = 0, first_kinetic_ = 0;
};

}  // namespace hyperex::test
