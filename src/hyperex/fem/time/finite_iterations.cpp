// SPDX-License-Identifier: GPL-3.0-or-later
// The iterations of FiniteNewton: one part of a step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/time/finite_newton_impl.hpp"

namespace hyperex::fem {
namespace {

using Eigen::VectorXd;

/// BDF2 with variable steps is stable if each step is less than 2.41 times the previous one
/// (Grigorieff, Numer. Math. 42, 1983).
constexpr double kMostGrowth = 2.0 + 1e-9;
/// A residual below this share of the last correction's right-hand side counts as zero.
constexpr double kNoResidual = 1e-9;
/// If rounding hides the remaining error, corrections of this share of the motion suffice for any
/// tolerance.
constexpr double kRounding = 1e-7;
/// Relative rounding error of the terms of an energy.
constexpr double kEnergyNoise = 1e-11;
/// If a correction is not smaller than the previous one, the matrix is factored again. Corrections
/// below kSmall tolerances are exempt: up to kForgiven of them are accepted with the old factor.
constexpr double kSmall = 10;
constexpr int kForgiven = 2;
constexpr int kBacktracks = 12;

RateRule rule_for(double h, double last_h) {
  if (!(last_h > 0) || h > kMostGrowth * last_h) return {1 / h, -1 / h, 0, h};
  const double w = h / last_h;
  return {(1 + 2 * w) / ((1 + w) * h), -(1 + w) / h, w * w / ((1 + w) * h), h};
}

}  // namespace

double greatest_motion(const VectorXd& d) {
  double most = 0;
  for (Eigen::Index n = 0; n < d.size(); n += 3)
    if (const double square = d.segment<3>(n).squaredNorm(); !(square <= most)) most = square;
  return std::sqrt(most);
}

void FiniteNewton::Impl::find_residual() {
  residual = gradient - external;
  for (std::size_t i = 0; i < factor->free().size(); ++i) q[i] = residual[factor->free()[i]];
}

/// Iterates one part of a step, of length h (0: statics), to `target` under `part_force`. Returns
/// true on convergence; x is then the state at the end of the part.
bool FiniteNewton::Impl::converge(double h, const VectorXd* guess, const FiniteNewtonHooks& hooks,
                                  FiniteStepReport& report) {
  begin(h, guess);
  external = part_force;
  Iterations now;
  now.energy = potential(x, gradient);
  const auto follow = [&] {
    if (hooks.before_iteration) {
      hooks.before_iteration(x, time + h, external);
      check_vector("the force of before_iteration", external, x.size(), "N");
    }
    find_residual();
  };
  follow();
  now.refactor = options.full_newton || age.is_due(rule.now);
  now.jumped = prescribed_change.isZero(0);
  const bool began_afresh = now.refactor;
  const int factorisations = report.factorisations + (began_afresh ? 1 : 0);
  int corrections = 0;
  for (int k = 0; k < options.most_iterations; ++k) {
    now.fresh = now.refactor || options.full_newton;
    if (now.fresh && !factor_at(x, report)) return false;
    if (!now.fresh && k == 0 && !form.linear()) turn_factor();
    now.refactor = false;
    if (now.fresh) now.forgiven = 0;
    const bool jumps = !now.jumped;
    find_direction(jumps);
    ++corrections;
    age.count_correction();
    if (k == 0) now.first_residual = right_side;
    now.size = greatest_motion(delta);
    now.share = 1;
    const Move move = jumps ? jump(now) : descend(now, report);
    if (move == Move::converged || move == Move::failed) return move == Move::converged;
    if (move == Move::again) continue;
    accept_trial(jumps);
    ++report.iterations;
    follow();
    const double scale = std::max(greatest_motion(x), options.least_motion_m);
    report.error = missing_m(now, k, scale) / scale;
    if (report.error <= options.tolerance || (now.at_rounding && report.error <= kRounding)) {
      age.count_part(began_afresh,
                     corrections + kFactorInCorrections * (report.factorisations - factorisations));
      return true;
    }
  }
  return false;
}

/// The factor of an earlier part, rotated to x. Pairs of secants belong to the rotation before.
void FiniteNewton::Impl::turn_factor() {
  turns.update(x);
  secants.clear();
}

/// The correction that moves the prescribed unknowns to their targets. They do work, so the energy
/// may increase.
FiniteNewton::Impl::Move FiniteNewton::Impl::jump(Iterations& now) {
  trial = x + delta;
  const double there = potential(trial, trial_gradient);
  if (!std::isfinite(there) || !trial_gradient.allFinite()) {
    if (now.fresh) return Move::failed;
    now.refactor = true;
    find_residual();
    return Move::again;
  }
  now.energy = there;
  now.jumped = true;
  return Move::made;
}

/// A correction that decreases the potential.
FiniteNewton::Impl::Move FiniteNewton::Impl::descend(Iterations& now, FiniteStepReport& report) {
  if (now.size == 0) {
    trial = x;
    trial_gradient = gradient;
    return Move::made;
  }
  now.share = search(now.energy);
  if (now.share != 0) return Move::made;
  find_residual();  // its storage was used for the direction
  if (!now.fresh) {
    now.refactor = true;  // the direction of the old factor is not a descent direction
    return Move::again;
  }
  // Very near the solution, rounding may hide any descent.
  report.error = now.size / std::max(greatest_motion(x), options.least_motion_m);
  const bool rounding = residual_is_rounding(now.first_residual) && report.error <= kRounding;
  return rounding || report.error <= options.tolerance ? Move::converged : Move::failed;
}

void FiniteNewton::Impl::accept_trial(bool jumped) {
  for (std::size_t i = 0; i < factor->free().size(); ++i) {
    const int u = factor->free()[i];
    s[i] = trial[u] - x[u];
    y[i] = trial_gradient[u] - gradient[u];
  }
  if (!jumped) secants.add(s, y);
  x.swap(trial);
  gradient.swap(trial_gradient);
}

/// Estimated distance of x from the solution (m), from the last two corrections. Also decides
/// whether a new factor is needed. `scale`: the length (m) to which the tolerance refers. The
/// residual alone is not sufficient: the first one may be very large, so that a small share of it
/// is still significant.
double FiniteNewton::Impl::missing_m(Iterations& now, int iteration, double scale) {
  double missing = now.size;
  const double left = q.norm();
  now.at_rounding = now.fresh && !(now.size < now.last_size) && iteration > 0 &&
                    left <= kNoResidual * now.first_residual;
  if (left <= kNoResidual * right_side && now.size <= 2 * scale) {
    // The matrix has accounted for all but this share of the force, as if the law were linear. This
    // does not hold after a large correction, as the tissue may have been much stiffer at its
    // start.
    missing = right_side > 0 ? 10 * left / right_side * now.size : 0;
  } else if (iteration > 0 && now.share == 1 && now.size < now.last_size) {
    const double rate = now.size / now.last_size;
    missing = rate / (1 - rate) * now.size;
    const double needed = std::log(options.tolerance * scale / missing) / std::log(rate);
    now.refactor = needed > kFactorInCorrections;
  } else if (iteration == 0) {
    missing = 10 * now.size;  // the convergence rate is still unknown
  } else {
    now.refactor = true;
  }
  if (now.refactor && now.size < kSmall * options.tolerance * scale && now.forgiven++ < kForgiven)
    now.refactor = false;
  now.last_size = now.share * now.size;
  return missing;
}

void FiniteNewton::Impl::begin(double h, const VectorXd* guess) {
  const bool dynamic = h > 0;
  rule = dynamic ? rule_for(h, last_h) : RateRule{0, 0, 0, std::numeric_limits<double>::infinity()};
  form.begin_step(rule, state.d, d_before);
  mass_share = dynamic && options.inertia ? rule.now * rule.now : 0;
  if (mass_share > 0)
    x_hat = -(rule.now * (rule.last * state.d + rule.before * d_before) + rule.last * state.v +
              rule.before * v_before) /
            mass_share;
  const auto& prescribed = factor->prescribed();
  if (guess) {
    x = *guess;
    for (std::size_t i = 0; i < prescribed.size(); ++i) x[prescribed[i]] = target[i];
  } else if (dynamic) {
    x = state.d + h * state.v;  // adding the acceleration makes this guess worse in most cases
  } else {
    x = state.d;
  }
  for (std::size_t i = 0; i < prescribed.size(); ++i)
    prescribed_change[i] = target[i] - x[prescribed[i]];
}

/// delta := -A^-1 residual. In the first iteration it includes the motion of the prescribed
/// unknowns to their targets.
void FiniteNewton::Impl::find_direction(bool jump) {
  const auto& free = factor->free();
  const auto& prescribed = factor->prescribed();
  delta.setZero();
  if (jump) {
    turned_change = prescribed_change;
    turns.turn_back(prescribed, turned_change);
    for (std::size_t i = 0; i < prescribed.size(); ++i) {
      const double by = turned_change[Eigen::Index(i)];
      if (by == 0) continue;
      for (SparseMatrix::InnerIterator it(matrix, prescribed[i]); it; ++it)
        delta[it.row()] += by * it.value();
    }
    for (std::size_t i = 0; i < free.size(); ++i) y[i] = delta[free[i]];
    turns.turn(free, y);
    q += y;
    delta.setZero();
  }
  q = -q;
  right_side = q.norm();
  secants.apply(q, [&](VectorXd& v) { solve(v); });
  for (std::size_t i = 0; i < free.size(); ++i) delta[free[i]] = q[i];
  if (jump)
    for (std::size_t i = 0; i < prescribed.size(); ++i) delta[prescribed[i]] = prescribed_change[i];
}

/// Line search: the share of delta at which the potential has decreased sufficiently (Armijo), or
/// is constant within rounding while its slope has become smaller (Hager and Zhang, SIAM J. Optim.
/// 16, 2005). Returns 0 if there is none. Otherwise trial and trial_gradient belong to that point,
/// and `energy` is the potential there.
double FiniteNewton::Impl::search(double& energy) {
  const double slope = residual.dot(delta);
  if (!(slope < 0)) return 0;
  const double at_x = energy - external.dot(x);
  double share = 1;
  for (int i = 0; i < kBacktracks; ++i) {
    trial = x + share * delta;
    const double there = potential(trial, trial_gradient);
    const double change = there - external.dot(trial) - at_x;
    const double noise =
        kEnergyNoise * (energy_scale + std::abs(external.dot(trial))) + form.energy_rounding();
    const double end_slope = trial_gradient.dot(delta) - external.dot(delta);
    if (std::isfinite(there) && trial_gradient.allFinite() &&
        (change <= 1e-4 * share * slope ||
         (change <= noise && std::abs(end_slope) <= 0.9 * std::abs(slope)))) {
      energy = there;
      return share;
    }
    // The minimum of the parabola through the known values.
    const double least = -slope * share * share / (2 * (change - slope * share));
    share = std::isfinite(least) ? std::clamp(least, 0.1 * share, 0.5 * share) : 0.1 * share;
  }
  return 0;
}

/// Whether the residual consists of rounding errors only.
bool FiniteNewton::Impl::residual_is_rounding(double first_residual) const {
  return q.norm() <= 1e-6 * first_residual;
}

}  // namespace hyperex::fem
