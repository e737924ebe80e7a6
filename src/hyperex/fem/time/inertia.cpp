// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/inertia.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

InertiaRows::InertiaRows(const System& system) {
  const SparseMatrix& c = system.damping;
  require(c.cols() % 3 == 0 && c.nonZeros() % 9 == 0,
          "System::damping has {} columns and {} entries: expected whole blocks of 3 x 3", c.cols(),
          c.nonZeros());
  start_.assign(1, 0);
  for (Eigen::Index n = 0; n < c.cols() / 3; ++n)
    start_.push_back(start_.back() + (c.outerIndexPtr()[3 * n + 1] - c.outerIndexPtr()[3 * n]) / 3);
  pair_.resize(start_.back());
  refill(system);
}

void InertiaRows::refill(const System& system) {
  const SparseMatrix &c = system.damping, &m = system.mass;
  require(c.nonZeros() == m.nonZeros() && c.nonZeros() == 9 * static_cast<int>(pair_.size()),
          "System: damping has {} entries and mass {}: expected {} each, in blocks of 3 x 3",
          c.nonZeros(), m.nonZeros(), 9 * pair_.size());
  tbb::parallel_for(std::size_t{0}, start_.size() - 1, [&](std::size_t n) {
    for (int axis = 0; axis < 3; ++axis) {
      // Both matrices are symmetric, so column r is also row r.
      int at = c.outerIndexPtr()[3 * n + axis];
      for (int k = start_[n]; k < start_[n + 1]; ++k, at += 3) {
        pair_[k].node = c.innerIndexPtr()[at] / 3;
        for (int j = 0; j < 3; ++j) {
          pair_[k].damping[3 * axis + j] = c.valuePtr()[at + j];
          require(
              axis == j || m.valuePtr()[at + j] == 0,
              "System::mass couples the axes of nodes {} and {}: expected the same mass on each "
              "axis alone",
              n, pair_[k].node);
        }
        pair_[k].mass = m.valuePtr()[at + axis];
      }
    }
  });
}

void InertiaRows::product(const Eigen::VectorXd& u, const Eigen::VectorXd& w,
                          Eigen::VectorXd& out) const {
  const int nodes = static_cast<int>(start_.size()) - 1;
  tbb::parallel_for(tbb::blocked_range<int>(0, nodes, 512), [&](const auto& range) {
    for (int n = range.begin(); n < range.end(); ++n) {
      double x = 0, y = 0, z = 0;
      for (int k = start_[n]; k < start_[n + 1]; ++k) {
        const Pair& p = pair_[k];
        const double *un = &u[3 * p.node], *wn = &w[3 * p.node], *c = p.damping;
        x += p.mass * un[0] + c[0] * wn[0] + c[1] * wn[1] + c[2] * wn[2];
        y += p.mass * un[1] + c[3] * wn[0] + c[4] * wn[1] + c[5] * wn[2];
        z += p.mass * un[2] + c[6] * wn[0] + c[7] * wn[1] + c[8] * wn[2];
      }
      out[3 * n] = x;
      out[3 * n + 1] = y;
      out[3 * n + 2] = z;
    }
  });
}

}  // namespace hyperex::fem
