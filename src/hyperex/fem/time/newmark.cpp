// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/newmark.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/time/inertia.hpp"

namespace hyperex::fem {
namespace {

/// The coefficients of Newmark's formulas for a step h.
struct Factors {
  double h;
  double m_d, m_v, m_a;  // coefficients of M in A and q
  double c_d, c_v, c_a;  // coefficients of C in A and q
  double v_old, v_new;   // coefficients of a in v1

  explicit Factors(const NewmarkOptions& o)
      : h(o.dt_s),
        m_d(1 / (o.beta * h * h)),
        m_v(1 / (o.beta * h)),
        m_a(1 / (2 * o.beta) - 1),
        c_d(o.gamma / (o.beta * h)),
        c_v(o.gamma / o.beta - 1),
        c_a(h * (o.gamma / (2 * o.beta) - 1)),
        v_old(h * (1 - o.gamma)),
        v_new(h * o.gamma) {}
};

}  // namespace

struct Newmark::Impl {
  Factors by;
  InertiaRows inertia;
  PartitionedFactor factor;
  SparseMatrix stiffness_oc;
  SparseMatrix stiffness, mass;  // used by start() only
  Kinematics state;
  Eigen::VectorXd u, w, q;  // q = M u + C w, all unknowns
  Eigen::VectorXd x_o;
  Kinematics own;  // state of the prescribed unknowns if only their displacement is given

  Impl(System s, std::vector<int> prescribed, const NewmarkOptions& options,
       std::shared_ptr<const NodeOrder> order)
      : by(options),
        inertia(s),
        factor(step_matrix(s, by), std::move(prescribed), "time integration", std::move(order)),
        stiffness_oc(coupling(s.stiffness, factor.partition())),
        stiffness(taken(s.stiffness)),
        mass(taken(s.mass)) {
    clear();
  }

  /// The matrix A of the step. Releases the damping matrix, whose values are already in `inertia`.
  static SparseMatrix step_matrix(System& s, const Factors& by) {
    SparseMatrix a = combined(s, by.c_d, by.m_d);
    taken(s.damping);
    return a;
  }

  void clear() {
    const Eigen::Index n = stiffness.cols();
    state.d = state.v = state.a = u = w = q = Eigen::VectorXd::Zero(n);
    x_o = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(factor.free().size()));
    own.d = own.v = own.a =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(factor.prescribed().size()));
  }

  void start(const Eigen::VectorXd& force) {
    const auto& free = factor.free();
    Eigen::VectorXd a_all = state.a;
    for (const int o : free) a_all[o] = 0;
    inertia.product(a_all, state.v, q);
    q += stiffness * state.d;
    Eigen::VectorXd rest = -q(free);
    if (force.size() > 0) rest += force(free);
    if (rest.isZero(0)) {
      state.a = a_all;
      return;
    }
    // The consistent mass of linear tetrahedra is well conditioned on any mesh: after scaling by
    // its diagonal, the condition number is at most 5 (Wathen, IMA J. Numer. Anal. 7, 1987).
    const SparseMatrix mass_oo = free_lower(mass, factor.partition());
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower> cg(mass_oo);
    cg.setTolerance(1e-14);
    a_all(free) = cg.solve(rest);
    if (!(cg.error() < 1e-10))
      throw NumericalError("time integration: the initial acceleration was not found");
    state.a = a_all;
  }

  void advance(const Kinematics& next, const Eigen::VectorXd& force) {
    const Eigen::VectorXd &d = state.d, &v = state.v, &a = state.a;
    u = by.m_d * d + by.m_v * v + by.m_a * a;
    w = by.c_d * d + by.c_v * v + by.c_a * a;
    const auto& prescribed = factor.prescribed();
    for (std::size_t i = 0; i < prescribed.size(); ++i) {
      u[prescribed[i]] = -next.a[i];
      w[prescribed[i]] = -next.v[i];
    }
    inertia.product(u, w, q);
    const auto& free = factor.free();
    if (force.size() > 0)
      for (std::size_t i = 0; i < free.size(); ++i) x_o[i] = q[free[i]] + force[free[i]];
    else
      for (std::size_t i = 0; i < free.size(); ++i) x_o[i] = q[free[i]];
    x_o.noalias() -= stiffness_oc * next.d;
    factor.solve(x_o);
    for (std::size_t i = 0; i < free.size(); ++i) {
      const int n = free[i];
      const double a_next = by.m_d * (x_o[i] - d[n]) - by.m_v * v[n] - by.m_a * a[n];
      state.v[n] += by.v_old * a[n] + by.v_new * a_next;
      state.a[n] = a_next;
      state.d[n] = x_o[i];
    }
    for (std::size_t i = 0; i < prescribed.size(); ++i) {
      state.d[prescribed[i]] = next.d[i];
      state.v[prescribed[i]] = next.v[i];
      state.a[prescribed[i]] = next.a[i];
    }
  }
};

Newmark::Newmark(System system, std::vector<int> prescribed, const NewmarkOptions& options,
                 std::shared_ptr<const NodeOrder> order) {
  check_positive("NewmarkOptions::dt_s", options.dt_s, " (s)");
  require(options.gamma >= 0.5 && 2 * options.beta >= options.gamma && std::isfinite(options.beta),
          "NewmarkOptions: beta = {}, gamma = {}: expected 2 beta >= gamma >= 1/2", options.beta,
          options.gamma);
  check_system(system);
  impl_ =
      std::make_unique<Impl>(std::move(system), std::move(prescribed), options, std::move(order));
}
Newmark::~Newmark() = default;
Newmark::Newmark(Newmark&&) noexcept = default;

void Newmark::refill(System system) {
  check_system(system);
  impl_->factor.refactor(combined(system, impl_->by.c_d, impl_->by.m_d));
  impl_->stiffness_oc = coupling(system.stiffness, impl_->factor.partition());
  impl_->inertia.refill(system);
  impl_->stiffness.swap(system.stiffness);
  impl_->mass.swap(system.mass);
  impl_->clear();
}

void Newmark::start(const Eigen::VectorXd& d, const Eigen::VectorXd& v,
                    const Eigen::VectorXd& prescribed_acceleration, const Eigen::VectorXd& force) {
  Kinematics& state = impl_->state;
  check_vector("the displacement", d, state.d.size(), "m");
  check_vector("the velocity", v, state.d.size(), "m/s");
  check_values("the prescribed acceleration", prescribed_acceleration, impl_->factor.prescribed(),
               "m/s^2");
  check_optional("the force", force, state.d.size(), "N");
  state.d = d;
  state.v = v;
  state.a(impl_->factor.prescribed()) = prescribed_acceleration;
  impl_->start(force);
}

void Newmark::step(const Kinematics& next, const Eigen::VectorXd& force) {
  const std::vector<int>& prescribed = impl_->factor.prescribed();
  check_values("the prescribed displacement", next.d, prescribed, "m");
  check_values("the prescribed velocity", next.v, prescribed, "m/s");
  check_values("the prescribed acceleration", next.a, prescribed, "m/s^2");
  check_optional("the force", force, impl_->state.d.size(), "N");
  impl_->advance(next, force);
}

void Newmark::step(const Eigen::VectorXd& prescribed_next, const Eigen::VectorXd& force) {
  const Factors& by = impl_->by;
  const Kinematics& state = impl_->state;
  const auto& prescribed = impl_->factor.prescribed();
  Kinematics& next = impl_->own;
  check_values("the prescribed displacement", prescribed_next, prescribed, "m");
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    const int n = prescribed[i];
    next.d[i] = prescribed_next[i];
    next.a[i] = by.m_d * (next.d[i] - state.d[n]) - by.m_v * state.v[n] - by.m_a * state.a[n];
    next.v[i] = state.v[n] + by.v_old * state.a[n] + by.v_new * next.a[i];
  }
  step(next, force);
}

void Newmark::set_state(const Eigen::VectorXd& d, const Eigen::VectorXd& v,
                        const Eigen::VectorXd& a) {
  Kinematics& state = impl_->state;
  check_vector("the displacement", d, state.d.size(), "m");
  check_vector("the velocity", v, state.d.size(), "m/s");
  check_vector("the acceleration", a, state.d.size(), "m/s^2");
  state = {d, v, a};
}

const Kinematics& Newmark::state() const {
  return impl_->state;
}
int Newmark::free_count() const {
  return static_cast<int>(impl_->x_o.size());
}
double Newmark::analyse_seconds() const {
  return impl_->factor.analyse_seconds();
}
double Newmark::factor_seconds() const {
  return impl_->factor.factor_seconds();
}
double Newmark::factor_entries() const {
  return impl_->factor.factor_entries();
}
const std::shared_ptr<const NodeOrder>& Newmark::order() const {
  return impl_->factor.order();
}
const std::vector<int>& Newmark::prescribed() const {
  return impl_->factor.prescribed();
}

}  // namespace hyperex::fem
