// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// M and C stored together, by pairs of nodes. The product M u + C w is limited by memory
/// bandwidth. Therefore the pattern is read once, the mass of a pair is a single number, and the
/// nine damping entries need no index of their own.
class InertiaRows {
 public:
  /// The blocks of the mass must be multiples of the identity, as for a consistent mass (asserted).
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
