// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/complementarity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/core/assert.hpp"

namespace hyperex::fem {
namespace {
constexpr int kPolishEvery = 10;  // sweeps
}

Complementarity solve_complementarity(const Eigen::MatrixXd& a, const Eigen::VectorXd& q,
                                      double tolerance, int most_sweeps, Eigen::VectorXd& z) {
  const Eigen::Index n = q.size();
  HX_ASSERT(a.rows() == n && a.cols() == n && z.size() == n);
  HX_ASSERT(n == 0 || a.diagonal().minCoeff() > 0);
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
  // As if the pairs that press now were those of the answer: exact once they are.
  Eigen::VectorXd tried(n), kept_w(n);
  std::vector<Eigen::Index> active;
  const auto polish = [&] {
    active.clear();
    for (Eigen::Index i = 0; i < n; ++i)
      if (z[i] > 0) active.push_back(i);
    if (active.empty()) return;
    const Eigen::VectorXd exact = -a(active, active).ldlt().solve(q(active));
    if (!exact.allFinite()) return;
    tried.setZero();
    tried(active) = exact.cwiseMax(0);
    const double before = residual();
    z.swap(tried);
    kept_w = w;
    w = q + a * z;
    if (residual() < before) return;
    z.swap(tried);
    w = kept_w;
  };
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
