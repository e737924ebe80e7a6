// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/finite_newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"

namespace hyperex::fem {
namespace {

using Eigen::VectorXd;

/// BDF2 on unequal steps keeps its stability while a step is less than 2.41 times the one before
/// (Grigorieff, Numer. Math. 42, 1983).
constexpr double kMostGrowth = 2.0 + 1e-9;
/// The residual that counts as none, of the first one.
constexpr double kNoResidual = 1e-9;
/// Share of the rounding in the terms of an energy.
constexpr double kEnergyNoise = 1e-11;
/// A new factor costs as much as this many corrections with the old one.
constexpr double kFactorInCorrections = 10;
/// A correction of less than this many tolerances that is no smaller than the one before it is no
/// reason for a new factor, so many times.
constexpr double kSmall = 10;
constexpr int kForgiven = 2;
constexpr int kMostPartsAfresh = 16;
/// Steps whose backward differences differ by less than this share can do with the same factor.
constexpr double kSameRate = 0.01;
constexpr int kBacktracks = 12;
/// The step that the first factor is made for; only its pattern matters later.
constexpr double kNominalStep_s = 0.01;

RateRule rule_for(double h, double last_h) {
  if (!(last_h > 0) || h > kMostGrowth * last_h) return {1 / h, -1 / h, 0, h};
  const double w = h / last_h;
  return {(1 + 2 * w) / ((1 + w) * h), -(1 + w) / h, w * w / ((1 + w) * h), h};
}

double greatest_motion(const VectorXd& d) {
  double most = 0;
  for (Eigen::Index n = 0; n < d.size(); n += 3)
    most = std::max(most, d.segment<3>(n).squaredNorm());
  return std::sqrt(most);
}

/// Corrections to a factor that has grown old (Nocedal, Math. Comp. 35, 1980): the last pairs of
/// step and change of the gradient.
class Secants {
 public:
  explicit Secants(Eigen::Index unknowns) {
    for (Pair& p : pair_) p.s = p.y = VectorXd::Zero(unknowns);
  }
  void clear() { count_ = 0; }
  void add(const VectorXd& s, const VectorXd& y) {
    const double sy = s.dot(y);
    if (!(sy > 1e-10 * s.norm() * y.norm())) return;
    Pair& p = pair_[count_ % kPairs];
    p.s = s;
    p.y = y;
    p.rho = 1 / sy;
    ++count_;
  }
  /// q := H q, `solve` being what H is without pairs.
  template <typename Solve>
  void apply(VectorXd& q, Solve solve) {
    const int first = std::max(0, count_ - kPairs);
    for (int i = count_ - 1; i >= first; --i) {
      Pair& p = pair_[i % kPairs];
      p.alpha = p.rho * p.s.dot(q);
      q -= p.alpha * p.y;
    }
    solve(q);
    for (int i = first; i < count_; ++i) {
      const Pair& p = pair_[i % kPairs];
      q += (p.alpha - p.rho * p.y.dot(q)) * p.s;
    }
  }

 private:
  static constexpr int kPairs = 5;
  struct Pair {
    VectorXd s, y;
    double rho = 0, alpha = 0;
  };
  std::array<Pair, kPairs> pair_;
  int count_ = 0;
};

}  // namespace

struct FiniteNewton::Impl {
  FiniteStrain& form;
  FiniteNewtonOptions options;
  SparseMatrix springs;
  std::vector<int> spring_places;  // of their entries among those of `matrix`
  std::vector<const NodalPotential*> potentials;
  SparseMatrix matrix;
  std::optional<PartitionedFactor> factor;

  Kinematics state;
  VectorXd d_before, v_before;
  double last_h = 0, time = 0;
  VectorXd force_last, start_prescribed;

  // Of the factor at hand: parts of steps that ended with it, corrections it made, and what the
  // last part cost, in corrections.
  int parts_with_factor = 0, corrections_with_factor = 0;
  double last_cost = 0;
  // Where an old factor did not pay, this many parts, and the next time twice as many, get their
  // own.
  int parts_afresh = 0, next_parts_afresh = 1;
  bool factor_is_rough = true;  // projected, or of the state at rest
  double rate_of_factor = -1;   // RateRule::now that it was made for

  // Of a part of a step.
  RateRule rule;
  double mass_share = 0;
  VectorXd x, x_hat, gradient, external, residual;  // all unknowns
  VectorXd trial, trial_gradient, delta, from_hat, mass_u, prescribed_change, target, part_force;
  VectorXd q, s, y;  // free unknowns
  Secants secants{0};
  double energy_scale = 0, right_side = 0;

  Impl(FiniteStrain& f, std::vector<int> prescribed, const FiniteNewtonOptions& o,
       SparseMatrix given_springs, std::vector<const NodalPotential*> given_potentials,
       LinearSolver wanted, std::shared_ptr<const NodeOrder> order)
      : form(f), options(o), potentials(std::move(given_potentials)) {
    springs.swap(given_springs);
    const Eigen::Index n = 3 * form.mesh().node_count();
    HX_ASSERT(springs.cols() == 0 || (springs.cols() == n && springs.rows() == n));
    matrix = form.mesh().stiffness_pattern();
    place_springs();
    for (VectorXd* v :
         {&state.d, &state.v, &state.a, &d_before, &v_before, &force_last, &x, &x_hat, &gradient,
          &external, &residual, &trial, &trial_gradient, &delta, &mass_u, &part_force})
      *v = VectorXd::Zero(n);
    form.rest_at(state.d);
    mass_share = options.inertia ? 1 / (kNominalStep_s * kNominalStep_s) : 0;
    fill_matrix(state.d, false);
    factor.emplace(matrix, std::move(prescribed), "time integration at finite strain",
                   form.mesh().nodes(), wanted, std::move(order));
    const auto count = static_cast<Eigen::Index>(factor->prescribed().size());
    start_prescribed = prescribed_change = target = VectorXd::Zero(count);
    q = s = y = VectorXd::Zero(n - count);
    secants = Secants(n - count);
  }

  void place_springs() {
    spring_places.reserve(static_cast<std::size_t>(springs.nonZeros()));
    for (int c = 0; c < springs.outerSize(); ++c)
      for (SparseMatrix::InnerIterator it(springs, c); it; ++it) {
        const int *from = matrix.innerIndexPtr() + matrix.outerIndexPtr()[c],
                  *to = matrix.innerIndexPtr() + matrix.outerIndexPtr()[c + 1];
        const int* at = std::lower_bound(from, to, static_cast<int>(it.row()));
        HX_ASSERT(at != to && *at == it.row());
        spring_places.push_back(static_cast<int>(at - matrix.innerIndexPtr()));
      }
  }

  void fill_matrix(const VectorXd& d, bool projected) {
    form.tangent(d, mass_share, projected, matrix);
    std::size_t k = 0;
    for (int c = 0; c < springs.outerSize(); ++c)
      for (SparseMatrix::InnerIterator it(springs, c); it; ++it)
        matrix.valuePtr()[spring_places[k++]] += it.value();
    if (potentials.empty()) return;
    TangentBlocks blocks(form.mesh().stiffness_neighbours(), matrix);
    for (const NodalPotential* p : potentials) p->add_tangent(d, blocks);
  }

  /// False where not even the projected matrix is positive definite.
  bool factor_at(const VectorXd& d, FiniteStepReport& report) {
    secants.clear();
    rate_of_factor = rule.now;
    parts_with_factor = corrections_with_factor = 0;
    fill_matrix(d, false);
    ++report.factorisations;
    factor_is_rough = factor->try_refactor(matrix) >= 0;
    if (!factor_is_rough) return true;
    fill_matrix(d, true);
    ++report.factorisations;
    ++report.projections;
    return factor->try_refactor(matrix) < 0;
  }

  /// Whether a part should begin with a new factor: an old one serves as long as that lets the mean
  /// cost of the parts with it fall.
  bool factor_is_due() const {
    return options.full_newton || factor_is_rough || parts_with_factor == 0 || parts_afresh > 0 ||
           std::abs(rate_of_factor - rule.now) > kSameRate * rule.now ||
           last_cost * parts_with_factor > kFactorInCorrections + corrections_with_factor;
  }

  /// A part has ended that cost as much as `cost` corrections, besides the factor it began with.
  void count_part(bool began_afresh, double cost) {
    ++parts_with_factor;
    last_cost = cost;
    if (began_afresh) {
      parts_afresh = std::max(0, parts_afresh - 1);
    } else if (cost > kFactorInCorrections) {
      parts_afresh = next_parts_afresh;
      next_parts_afresh = std::min(2 * next_parts_afresh, kMostPartsAfresh);
    } else {
      next_parts_afresh = std::max(1, next_parts_afresh / 2);
    }
  }

  /// The incremental potential without external forces, and its gradient.
  double potential(const VectorXd& d, VectorXd& out) {
    double sum = form.energy_and_gradient(d, out);
    energy_scale = std::abs(sum);
    const auto count = [&](double e) {
      sum += e;
      energy_scale += std::abs(e);
    };
    if (mass_share > 0) {
      from_hat = d - x_hat;
      form.mass_product(from_hat, mass_u);
      out += mass_share * mass_u;
      count(mass_share / 2 * from_hat.dot(mass_u));
    }
    if (springs.cols() > 0) {
      mass_u.noalias() = springs * d;
      out += mass_u;
      count(mass_u.dot(d) / 2);
    }
    for (const NodalPotential* p : potentials) count(p->add_gradient(d, out));
    return sum;
  }

  void find_residual() {
    residual = gradient - external;
    for (std::size_t i = 0; i < factor->free().size(); ++i) q[i] = residual[factor->free()[i]];
  }

  /// A part of a step of length h (0: statics) to `target` under `part_force`. True: x is its end.
  bool converge(double h, const VectorXd* guess, const FiniteNewtonHooks& hooks,
                FiniteStepReport& report) {
    begin(h, guess);
    external = part_force;
    double energy = potential(x, gradient);
    if (hooks.before_iteration) hooks.before_iteration(x, time + h, external);
    find_residual();
    double first_residual = 0, last_size = 0;
    bool refactor = factor_is_due(), jumped = prescribed_change.isZero(0);
    const bool began_afresh = refactor;
    const int factorisations = report.factorisations + (refactor ? 1 : 0);
    int corrections = 0, forgiven = 0;
    for (int k = 0; k < options.most_iterations; ++k) {
      const bool fresh = refactor || options.full_newton;
      if (fresh && !factor_at(x, report)) return false;
      refactor = false;
      if (fresh) forgiven = 0;
      const bool jump = !jumped;
      find_direction(jump);
      ++corrections, ++corrections_with_factor;
      if (k == 0) first_residual = right_side;
      const double size = greatest_motion(delta);
      double share = 1;
      if (jump) {  // what is prescribed does work: the energy may well rise
        trial = x + delta;
        const double there = potential(trial, trial_gradient);
        if (!std::isfinite(there) || !trial_gradient.allFinite()) {
          if (fresh) return false;
          refactor = true;
          find_residual();
          continue;
        }
        energy = there;
        jumped = true;
      } else if (size > 0) {
        share = search(energy);
        if (share == 0) {
          find_residual();  // the search's direction stood in its place
          if (fresh) {
            // At an iterate as good as found there may be no descent that rounding does not hide.
            report.error = size / std::max(greatest_motion(x), options.least_motion_m);
            return residual_is_rounding(first_residual) || report.error <= options.tolerance;
          }
          refactor = true;  // the old factor's direction leads nowhere
          continue;
        }
      } else {
        trial = x;
        trial_gradient = gradient;
      }
      for (std::size_t i = 0; i < factor->free().size(); ++i) {
        const int u = factor->free()[i];
        s[i] = trial[u] - x[u];
        y[i] = trial_gradient[u] - gradient[u];
      }
      if (!jump) secants.add(s, y);
      x.swap(trial);
      gradient.swap(trial_gradient);
      ++report.iterations;
      if (hooks.before_iteration) hooks.before_iteration(x, time + h, external);
      find_residual();

      const double scale = std::max(greatest_motion(x), options.least_motion_m);
      double missing = size;
      if (q.norm() <= kNoResidual * first_residual) {
        missing = 0;
      } else if (k > 0 && share == 1 && size < last_size) {
        const double rate = size / last_size;
        missing = rate / (1 - rate) * size;
        const double needed = std::log(options.tolerance * scale / missing) / std::log(rate);
        refactor = needed > kFactorInCorrections;
      } else if (k == 0) {
        missing = 10 * size;  // nothing is known of the rate yet
      } else {
        refactor = true;
      }
      if (refactor && size < kSmall * options.tolerance * scale && forgiven++ < kForgiven)
        refactor = false;
      last_size = share * size;
      report.error = missing / scale;
      if (report.error <= options.tolerance) {
        count_part(began_afresh,
                   corrections + kFactorInCorrections * (report.factorisations - factorisations));
        return true;
      }
    }
    return false;
  }

  void begin(double h, const VectorXd* guess) {
    const bool dynamic = h > 0;
    rule =
        dynamic ? rule_for(h, last_h) : RateRule{0, 0, 0, std::numeric_limits<double>::infinity()};
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
      x = state.d + h * state.v;  // the acceleration besides leads farther off more often than not
    } else {
      x = state.d;
    }
    for (std::size_t i = 0; i < prescribed.size(); ++i)
      prescribed_change[i] = target[i] - x[prescribed[i]];
  }

  /// delta := -A^-1 residual, with the prescribed unknowns' way to their target in the first
  /// iteration.
  void find_direction(bool jump) {
    const auto& free = factor->free();
    const auto& prescribed = factor->prescribed();
    delta.setZero();
    if (jump) {
      for (std::size_t i = 0; i < prescribed.size(); ++i) {
        const double by = prescribed_change[i];
        if (by == 0) continue;
        for (SparseMatrix::InnerIterator it(matrix, prescribed[i]); it; ++it)
          delta[it.row()] += by * it.value();
      }
      for (std::size_t i = 0; i < free.size(); ++i) q[i] += delta[free[i]];
      delta.setZero();
    }
    q = -q;
    right_side = q.norm();
    secants.apply(q, [&](VectorXd& v) { factor->solve(v); });
    for (std::size_t i = 0; i < free.size(); ++i) delta[free[i]] = q[i];
    if (jump)
      for (std::size_t i = 0; i < prescribed.size(); ++i)
        delta[prescribed[i]] = prescribed_change[i];
  }

  /// The share of delta at which the potential has fallen enough (Armijo), or is level within its
  /// rounding while its slope has become smaller (Hager and Zhang, SIAM J. Optim. 16, 2005); 0:
  /// none. trial and trial_gradient are then those there, `energy` the potential there.
  double search(double& energy) {
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
      // The least of the parabola through what is known.
      const double least = -slope * share * share / (2 * (change - slope * share));
      share = std::isfinite(least) ? std::clamp(least, 0.1 * share, 0.5 * share) : 0.1 * share;
    }
    return 0;
  }

  /// Whether nothing is left to gain but rounding.
  bool residual_is_rounding(double first_residual) const {
    return q.norm() <= 1e-6 * first_residual;
  }

  void take(double h) {
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

  [[noreturn]] void fail(double h) {
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

  FiniteStepReport advance(double dt, const VectorXd& prescribed, const VectorXd& force,
                           const FiniteNewtonHooks& hooks, const VectorXd* guess) {
    HX_ASSERT(prescribed.size() == target.size());
    HX_ASSERT(force.size() == 0 || force.size() == state.d.size());
    HX_ASSERT(!guess || guess->size() == state.d.size());
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
        parts_with_factor = 0;  // it may be to blame
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
};

FiniteNewton::FiniteNewton(FiniteStrain& form, std::vector<int> prescribed,
                           const FiniteNewtonOptions& options, SparseMatrix springs,
                           std::vector<const NodalPotential*> potentials, LinearSolver wanted,
                           std::shared_ptr<const NodeOrder> order) {
  HX_ASSERT(options.tolerance > 0 && options.least_motion_m > 0 && options.most_iterations > 0);
  HX_ASSERT(options.most_halvings >= 0 && options.most_halvings < 30);
  impl_ = std::make_unique<Impl>(form, std::move(prescribed), options, std::move(springs),
                                 std::move(potentials), wanted, std::move(order));
}
FiniteNewton::~FiniteNewton() = default;
FiniteNewton::FiniteNewton(FiniteNewton&&) noexcept = default;

void FiniteNewton::start(const VectorXd& d, const VectorXd& v, const VectorXd& force) {
  Impl& m = *impl_;
  HX_ASSERT(d.size() == m.state.d.size() && v.size() == d.size());
  HX_ASSERT(force.size() == 0 || force.size() == d.size());
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
  HX_ASSERT(dt_s > 0);
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
LinearSolver FiniteNewton::solver() const {
  return impl_->factor->solver();
}
const std::shared_ptr<const NodeOrder>& FiniteNewton::order() const {
  return impl_->factor->order();
}

void FiniteNewton::solve(VectorXd& x) {
  Impl& m = *impl_;
  HX_ASSERT(x.size() == m.state.d.size());
  const auto& free = m.factor->free();
  for (std::size_t i = 0; i < free.size(); ++i) m.y[i] = x[free[i]];
  m.factor->solve(m.y);
  x.setZero();
  for (std::size_t i = 0; i < free.size(); ++i) x[free[i]] = m.y[i];
}

}  // namespace hyperex::fem
