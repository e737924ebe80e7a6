// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity and Maxwell branches of FiniteStrain: the potentials that a time step adds.
#include <algorithm>
#include <cmath>

#include "hyperex/fem/form/finite_kinematics.hpp"
#include "hyperex/fem/form/for_each_index.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

using Eigen::Matrix3d;

namespace {

/// In an element whose strain changed by more than this in the previous step, the rate is taken
/// from the current step alone. Extrapolating such a change makes BDF2 unstable.
constexpr double kMostExtrapolated = 0.1;

}  // namespace

/// S = F^-1 dW/dF.
Matrix3d FiniteStrain::law_stress(const Matrix3d& f, double shear_pa) const {
  if (linear()) {
    Hyperelastic plain;
    plain.law = HyperelasticLaw::linear;
    return first_piola_pa(plain, shear_pa, f);
  }
  const Matrix3d cof = cofactor(f), c = f.transpose() * f;
  const double i1 = f.squaredNorm(), j = determinant(f);
  const LawResponse r = respond(law_, shear_pa, i1, cof.squaredNorm(), j);
  // F^-1 cof F = (cof C) / J, which is singular for a flat element.
  const double divisor = std::abs(j) > kLeastRatio ? j : std::copysign(kLeastRatio, j);
  Matrix3d s = -2 * r.d2 * c + r.dj / divisor * cofactor(c);
  s.diagonal().array() += 2 * (r.d1 + r.d2 * i1);
  return s;
}

/// Computes E^, C*^-1 and 2 eta J* now of element t. F: the gradient at the last displacement.
void FiniteStrain::set_viscous_step(Eigen::Index t, const RateRule& rule, double w,
                                    const Matrix3d& f, const Eigen::VectorXd& before) {
  StepData& step = step_[t];
  double now = 1 / rule.step_s;
  step.strain = strain_of(f);
  Matrix3d c = f.transpose() * f, inverse = c.inverse();
  if (linear() || !inverse.allFinite()) {
    c.setIdentity();
    inverse.setIdentity();
  }
  if (rule.before != 0) {
    const Matrix3d g = gradient_at(before, t), change = step.strain - strain_of(g);
    if (linear() || (inverse * change).norm() < kMostExtrapolated) {
      now = rule.now;
      step.strain += rule.before / rule.now * change;
      // C* = C (w C_before^-1 + (1 - w) C^-1) C = C + w (C - C_before) + ..., positive definite for
      // 0 <= w <= 1.
      if (!linear()) c = w * (c * (g.transpose() * g).inverse() * c) + (1 - w) * c;
      inverse = c.inverse();
    }
  }
  step.metric = inverse;
  // A nearly flat element keeps a small viscosity.
  step.viscosity =
      2 * viscosity_[t] * std::sqrt(std::max(determinant(c), kLeastRatio * kLeastRatio)) * now;
}

void FiniteStrain::begin_step(const RateRule& rule, const Eigen::VectorXd& last,
                              const Eigen::VectorXd& before) {
  check_size("the last displacement", last.size(), 3 * mesh_.node_count());
  check_size("the displacement before", before.size(), last.size());
  require(rule.now >= 0 && rule.step_s >= 0, "RateRule: now = {}, step_s = {}: expected 0 or more",
          rule.now, rule.step_s);
  branch_share_ = 0;
  for (std::size_t i = 0; i < fade_.size(); ++i) {
    const MaxwellBranch& branch = law_.branches[i];
    const double x = rule.step_s / branch.relaxation_s;
    fade_[i] = std::exp(-x);
    share_[i] = x > 0 ? -branch.ratio * std::expm1(-x) / x : branch.ratio;
    branch_share_ += share_[i];
  }
  if (!has_rates()) return;
  // w is the extrapolation factor: the ratio of the steps, which follows from the rule, at most 1.
  const double size = rule.now > 0 ? rule.before / rule.now : 0;  // w^2 / (1 + 2 w)
  const double w = std::min(1.0, size + std::sqrt(size * size + size));
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    StepData& step = step_[t];
    const Matrix3d f = gradient_at(last, t);
    step.viscosity = 0;
    step.metric.setIdentity();
    step.strain.setZero();
    step.stress.setZero();
    if (viscosity_[t] > 0 && rule.now > 0) set_viscous_step(t, rule, w, f, before);
    for (std::size_t i = 0; i < branch_.size(); ++i)
      step.stress += fade_[i] * branch_[i][t] - share_[i] * law_stress_[t];
  });
}

void FiniteStrain::accept(const Eigen::VectorXd& d) {
  check_size("the displacement", d.size(), 3 * mesh_.node_count());
  if (branch_.empty()) return;
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    const Matrix3d now = law_stress(gradient_at(d, t), moduli_[t].shear);
    for (std::size_t i = 0; i < branch_.size(); ++i)
      branch_[i][t] = fade_[i] * branch_[i][t] + share_[i] * (now - law_stress_[t]);
    law_stress_[t] = now;
  });
}

void FiniteStrain::rest_at(const Eigen::VectorXd& d) {
  check_size("the displacement", d.size(), 3 * mesh_.node_count());
  branch_share_ = 0;
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    step_[t] = {Matrix3d::Identity(), Matrix3d::Zero(), Matrix3d::Zero(), 0};
    if (branch_.empty()) return;
    law_stress_[t] = law_stress(gradient_at(d, t), moduli_[t].shear);
    for (auto& q : branch_) q[t].setZero();
  });
}

}  // namespace hyperex::fem
