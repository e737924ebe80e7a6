// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/finite_newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/time/finite_newton_impl.hpp"

namespace hyperex::fem {
namespace {

using Eigen::VectorXd;

/// The step for which the first factor is computed. Only its pattern is used later.
constexpr double kNominalStep_s = 0.01;

}  // namespace

FiniteNewton::Impl::Impl(FiniteStrain& f, std::vector<int> prescribed, const FiniteNewtonOptions& o,
                         SparseMatrix given_springs,
                         std::vector<const NodalPotential*> given_potentials,
                         std::shared_ptr<const NodeOrder> order)
    : form(f), options(o), potentials(std::move(given_potentials)), turns(f.mesh()) {
  springs.swap(given_springs);
  const Eigen::Index n = 3 * form.mesh().node_count();
  check_matrix("the springs' matrix", springs);
  require(springs.cols() == 0 || springs.cols() == n,
          "the springs' matrix is {0} x {0}: expected {1} x {1}", springs.cols(), n);
  matrix = form.mesh().stiffness_pattern();
  place_springs();
  for (VectorXd* v :
       {&state.d, &state.v, &state.a, &d_before, &v_before, &force_last, &x, &x_hat, &gradient,
        &external, &residual, &trial, &trial_gradient, &delta, &mass_u, &part_force})
    *v = VectorXd::Zero(n);
  form.rest_at(state.d);
  mass_share = options.inertia ? 1 / (kNominalStep_s * kNominalStep_s) : 0;
  // The mesh of grown tissue is under stress, where the exact matrix may be indefinite.
  fill_matrix(state.d, form.mesh().has_grown());
  factor.emplace(matrix, std::move(prescribed), "time integration at finite strain",
                 std::move(order));
  const auto count = static_cast<Eigen::Index>(factor->prescribed().size());
  start_prescribed = prescribed_change = turned_change = target = VectorXd::Zero(count);
  q = s = y = VectorXd::Zero(n - count);
  secants = Secants(n - count);
}

void FiniteNewton::Impl::take(double h) {
  form.accept(x);
  if (h > 0) {
    trial = rule.now * x + rule.last * state.d + rule.before * d_before;  // v
    trial_gradient = rule.now * trial + rule.last * state.v + rule.before * v_before;
    d_before.swap(state.d);
    v_before.swap(state.v);
    state.d = x;
    state.v = trial;
    state.a = trial_gradient;
    last_h = h;
    time += h;
  } else {
    state.d = d_before = x;
    state.v.setZero();
    v_before.setZero();
    state.a.setZero();
    last_h = 0;
  }
}

void FiniteNewton::Impl::fail(double h) {
  int worst = factor->free().empty() ? 0 : factor->free().front();
  for (const int u : factor->free())
    if (!(std::abs(residual[u]) <= std::abs(residual[worst]))) worst = u;
  Eigen::Index element = 0;
  const double ratio = form.volume_ratio(x).minCoeff(&element);
  throw NumericalError(fmt::format(
      "{}: no equilibrium was found at t = {:.6g} s, not even in parts {:.3g} of the step (after "
      "{} iterations): the force that is left is greatest at node {} ({:.3g} N, axis {}), the "
      "most compressed is tetrahedron {} ({:.3g} of its volume)",
      h > 0 ? "time integration at finite strain" : "equilibrium at finite strain", time + h,
      std::pow(0.5, options.most_halvings), options.most_iterations, worst / 3, residual[worst],
      "xyz"[worst % 3], element, ratio));
}

FiniteStepReport FiniteNewton::Impl::advance(double dt, const VectorXd& prescribed,
                                             const VectorXd& force, const FiniteNewtonHooks& hooks,
                                             const VectorXd* guess) {
  check_values("the prescribed displacement", prescribed, factor->prescribed(), "m");
  check_optional("the force", force, state.d.size(), "N");
  if (guess) check_vector("the guess", *guess, state.d.size(), "m");
  FiniteStepReport report;
  for (std::size_t i = 0; i < factor->prescribed().size(); ++i)
    start_prescribed[i] = state.d[factor->prescribed()[i]];
  const int whole = 1 << options.most_halvings;
  int done = 0, part = whole;
  double error = 0;
  while (done < whole) {
    const double h = dt * part / whole, until = static_cast<double>(done + part) / whole;
    if (done + part == whole)
      target = prescribed;
    else
      target = start_prescribed + until * (prescribed - start_prescribed);
    if (force.size() > 0)
      part_force = (1 - until) * force_last + until * force;
    else
      part_force = (1 - until) * force_last;
    if (!converge(h, part == whole ? guess : nullptr, hooks, report)) {
      if (part == 1) fail(h);
      age.retire();  // the failure may be due to an old factor
      part /= 2;
      continue;
    }
    take(h);
    error = std::max(error, report.error);
    ++report.parts;
    done += part;
    if (hooks.after_part) hooks.after_part(time);
    if (done % (2 * part) == 0) part *= 2;
    while (part > whole - done && part > 1) part /= 2;
  }
  report.error = error;
  if (force.size() > 0)
    force_last = force;
  else
    force_last.setZero();
  return report;
}

FiniteNewton::FiniteNewton(FiniteStrain& form, std::vector<int> prescribed,
                           const FiniteNewtonOptions& options, SparseMatrix springs,
                           std::vector<const NodalPotential*> potentials,
                           std::shared_ptr<const NodeOrder> order) {
  check_positive("FiniteNewtonOptions::tolerance", options.tolerance);
  check_positive("FiniteNewtonOptions::least_motion_m", options.least_motion_m, " (m)");
  check_positive("FiniteNewtonOptions::most_iterations", options.most_iterations);
  require(options.most_halvings >= 0 && options.most_halvings < 30,
          "FiniteNewtonOptions::most_halvings = {}: expected 0 to 29", options.most_halvings);
  for (const NodalPotential* p : potentials)
    require(p != nullptr, "FiniteNewton: a potential is null: expected the address of one");
  impl_ = std::make_unique<Impl>(form, std::move(prescribed), options, std::move(springs),
                                 std::move(potentials), std::move(order));
}
FiniteNewton::~FiniteNewton() = default;
FiniteNewton::FiniteNewton(FiniteNewton&&) noexcept = default;

void FiniteNewton::start(const VectorXd& d, const VectorXd& v, const VectorXd& force) {
  Impl& m = *impl_;
  check_vector("the displacement", d, m.state.d.size(), "m");
  check_vector("the velocity", v, d.size(), "m/s");
  check_optional("the force", force, d.size(), "N");
  m.state.d = m.d_before = d;
  m.state.v = m.v_before = v;
  m.state.a.setZero();
  if (force.size() > 0)
    m.force_last = force;
  else
    m.force_last.setZero();
  m.residual.setZero();
  m.last_h = m.time = 0;
  m.form.rest_at(d);
}

void FiniteNewton::start() {
  const VectorXd zero = VectorXd::Zero(impl_->state.d.size());
  start(zero, zero);
}

FiniteStepReport FiniteNewton::step(double dt_s, const VectorXd& prescribed, const VectorXd& force,
                                    const FiniteNewtonHooks& hooks, const VectorXd* guess) {
  check_positive("the step dt_s", dt_s, " (s)");
  return impl_->advance(dt_s, prescribed, force, hooks, guess);
}

FiniteStepReport FiniteNewton::equilibrium(const VectorXd& prescribed, const VectorXd& force,
                                           const FiniteNewtonHooks& hooks, const VectorXd* guess) {
  return impl_->advance(0, prescribed, force, hooks, guess);
}

double FiniteNewton::time_s() const {
  return impl_->time;
}
const VectorXd& FiniteNewton::displacement() const {
  return impl_->state.d;
}
const VectorXd& FiniteNewton::velocity() const {
  return impl_->state.v;
}
const VectorXd& FiniteNewton::acceleration() const {
  return impl_->state.a;
}
const VectorXd& FiniteNewton::reaction() const {
  return impl_->residual;
}
const std::vector<int>& FiniteNewton::prescribed() const {
  return impl_->factor->prescribed();
}
int FiniteNewton::free_count() const {
  return static_cast<int>(impl_->factor->free().size());
}
const std::shared_ptr<const NodeOrder>& FiniteNewton::order() const {
  return impl_->factor->order();
}

void FiniteNewton::solve(VectorXd& x) {
  Impl& m = *impl_;
  check_vector("the force", x, m.state.d.size(), "N");
  const auto& free = m.factor->free();
  for (std::size_t i = 0; i < free.size(); ++i) m.y[i] = x[free[i]];
  m.solve(m.y);
  x.setZero();
  for (std::size_t i = 0; i < free.size(); ++i) x[free[i]] = m.y[i];
}

}  // namespace hyperex::fem
