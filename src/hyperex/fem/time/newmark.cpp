// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/newmark.hpp"

#include <tbb/parallel_for.h>

#include <cassert>

#include "hyperex/fem/solve/partitioned_factor.hpp"

namespace hyperex::fem {
namespace {

/// The rows of M and C of the free unknowns, interleaved: q is bound by memory, and so reads the
/// pattern once.
struct InertiaRows {
  struct Entry {
    double mass, damping;
    int column;
  };
  std::vector<int> start{0};
  std::vector<Entry> entries;

  InertiaRows(const System& system, const std::vector<int>& rows) {
    // Both are symmetric: column r is row r.
    entries.reserve(system.mass.nonZeros());
    for (const int r : rows) {
      const int end = system.mass.outerIndexPtr()[r + 1];
      for (int k = system.mass.outerIndexPtr()[r]; k < end; ++k)
        entries.push_back({system.mass.valuePtr()[k], system.damping.valuePtr()[k],
                           system.mass.innerIndexPtr()[k]});
      start.push_back(static_cast<int>(entries.size()));
    }
  }

  /// out += M_o. u + C_o. w. Each row is summed by one thread in its own order.
  void add_product(const Eigen::VectorXd& u, const Eigen::VectorXd& w, Eigen::VectorXd& out) const {
    tbb::parallel_for(Eigen::Index{0}, out.size(), [&](Eigen::Index r) {
      double sum = 0;
      for (int k = start[r]; k < start[r + 1]; ++k)
        sum += entries[k].mass * u[entries[k].column] + entries[k].damping * w[entries[k].column];
      out[r] += sum;
    });
  }
};

SparseMatrix effective_stiffness(const System& system, double dt_s) {
  assert(system.stiffness.nonZeros() == system.damping.nonZeros());
  assert(system.stiffness.nonZeros() == system.mass.nonZeros());
  SparseMatrix a = system.stiffness;
  a.coeffs() += 4 / (dt_s * dt_s) * system.mass.coeffs() + 2 / dt_s * system.damping.coeffs();
  return a;
}

}  // namespace

struct Newmark::Impl {
  double dt_s;
  PartitionedFactor factor;
  InertiaRows inertia;
  Eigen::VectorXd d, v, a;  // all unknowns
  Eigen::VectorXd d_next;   // all unknowns
  Eigen::VectorXd u, w;     // the vectors that M and C multiply in q
  Eigen::VectorXd x_o;      // free unknowns

  Impl(const System& system, std::vector<int> prescribed, double dt)
      : dt_s(dt),
        factor(effective_stiffness(system, dt), std::move(prescribed), "time integration"),
        inertia(system, factor.free()) {
    const Eigen::Index n = system.stiffness.cols();
    d = v = a = d_next = u = w = Eigen::VectorXd::Zero(n);
    x_o = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(factor.free().size()));
  }

  /// From x_o = f_o to the state at t+1.
  void advance(const Eigen::VectorXd& prescribed_next) {
    const double two_dt = 2 / dt_s, four_dt2 = 4 / (dt_s * dt_s);
    u = four_dt2 * d + 2 * two_dt * v + a;
    w = two_dt * d + v;
    inertia.add_product(u, w, x_o);
    factor.solve(prescribed_next, x_o);
    d_next(factor.free()) = x_o;
    d_next(factor.prescribed()) = prescribed_next;
    a = four_dt2 * (d_next - d) - 2 * two_dt * v - a;
    v = two_dt * (d_next - d) - v;
    d.swap(d_next);
  }
};

Newmark::Newmark(const System& system, std::vector<int> prescribed, double dt_s) {
  assert(dt_s > 0);
  impl_ = std::make_unique<Impl>(system, std::move(prescribed), dt_s);
}
Newmark::~Newmark() = default;
Newmark::Newmark(Newmark&&) noexcept = default;

void Newmark::step(const Eigen::VectorXd& prescribed_next) {
  impl_->x_o.setZero();
  impl_->advance(prescribed_next);
}

void Newmark::step(const Eigen::VectorXd& prescribed_next, const Eigen::VectorXd& force_next) {
  assert(force_next.size() == impl_->d.size());
  impl_->x_o = force_next(impl_->factor.free());
  impl_->advance(prescribed_next);
}

void Newmark::set_state(const Eigen::VectorXd& d, const Eigen::VectorXd& v,
                        const Eigen::VectorXd& a) {
  assert(d.size() == impl_->d.size() && v.size() == d.size() && a.size() == d.size());
  impl_->d = d;
  impl_->v = v;
  impl_->a = a;
}

const Eigen::VectorXd& Newmark::displacement() const {
  return impl_->d;
}
const Eigen::VectorXd& Newmark::velocity() const {
  return impl_->v;
}
const Eigen::VectorXd& Newmark::acceleration() const {
  return impl_->a;
}
int Newmark::free_count() const {
  return static_cast<int>(impl_->x_o.size());
}
double Newmark::factor_seconds() const {
  return impl_->factor.factor_seconds();
}

}  // namespace hyperex::fem
