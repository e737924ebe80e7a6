// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/complementarity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {
namespace {
constexpr int kPolishEvery = 10;  // sweeps
constexpr int kMostNewton = 20;

void check_problem(const Eigen::MatrixXd& a, const Eigen::VectorXd& q, const Eigen::VectorXd& z) {
  const Eigen::Index n = q.size();
  require(a.rows() == n && a.cols() == n && z.size() == n,
          "complementarity: A is {} x {}, q has {} entries and z {}: expected as many each",
          a.rows(), a.cols(), n, z.size());
  for (Eigen::Index i = 0; i < n; ++i)
    require(
        a(i, i) > 0 && std::isfinite(q[i]) && std::isfinite(z[i]),
        "complementarity: row {} has the diagonal {}, q = {} and z = {}: expected finite numbers, "
        "the diagonal above 0",
        i, a(i, i), q[i], z[i]);
}

}  // namespace

Complementarity solve_complementarity(const Eigen::MatrixXd& a, const Eigen::VectorXd& q,
                                      double tolerance, int most_sweeps, Eigen::VectorXd& z) {
  check_problem(a, q, z);
  const Eigen::Index n = q.size();
  z = z.cwiseMax(0);
  Eigen::VectorXd w = q + a * z;
  const auto relax = [&](Eigen::Index i) {
    const double next = std::max(0.0, z[i] - w[i] / a(i, i));
    const double change = next - z[i];
    if (change == 0) return;
    z[i] = next;
    w.noalias() += change * a.col(i);
  };
  Complementarity out;
  const auto residual = [&] {
    return n == 0 ? 0 : w.cwiseMin(a.diagonal().cwiseProduct(z)).cwiseAbs().maxCoeff();
  };
  // Newton's method for min(w, a_ii z) = 0. Solves exactly with the active set a_ii z > w, until
  // this set is the same twice in a row. The result is kept if the residual is smaller.
  Eigen::VectorXd before_z(n), before_w(n);
  std::vector<Eigen::Index> active, were;
  const auto polish = [&] {
    const double before = residual();
    before_z = z;
    before_w = w;
    were.clear();
    for (int k = 0; k < kMostNewton; ++k) {
      active.clear();
      for (Eigen::Index i = 0; i < n; ++i)
        if (a(i, i) * z[i] > w[i]) active.push_back(i);
      if (active.empty() || active == were) break;
      const Eigen::VectorXd exact = -a(active, active).ldlt().solve(q(active));
      if (!exact.allFinite()) break;
      z.setZero();
      z(active) = exact;
      w.noalias() = q + a * z;
      were = active;
    }
    z = z.cwiseMax(0);
    w.noalias() = q + a * z;
    if (residual() < before) return;
    z = before_z;
    w = before_w;
  };
  if (residual() > tolerance) polish();
  for (out.residual = residual(); out.residual > tolerance && out.sweeps < most_sweeps;
       out.residual = residual()) {
    if (out.sweeps++ % 2 == 0)
      for (Eigen::Index i = 0; i < n; ++i) relax(i);
    else
      for (Eigen::Index i = n - 1; i >= 0; --i) relax(i);
    if (out.sweeps % kPolishEvery == 0 && residual() > tolerance) polish();
  }
  return out;
}

}  // namespace hyperex::fem
