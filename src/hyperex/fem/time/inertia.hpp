// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// M and C interleaved by pairs of nodes: M u + C w is bound by memory, and so the pattern is read
/// once, the mass of a pair is one number, and the nine dampings need no index of their own.
class InertiaRows {
 public:
  /// Mass blocks must be multiples of the identity, as a consistent mass is: asserted.
  explicit InertiaRows(const System& system);
  void refill(const System& system);

  /// out := M u + C w over all unknowns. Each row is summed by one thread in its own order.
  void product(const Eigen::VectorXd& u, const Eigen::VectorXd& w, Eigen::VectorXd& out) const;

 private:
  struct Pair {
    double damping[9];  // row-major
    double mass;
    int node;
  };
  std::vector<int> start_;  // per node
  std::vector<Pair> pair_;
};

}  // namespace hyperex::fem
