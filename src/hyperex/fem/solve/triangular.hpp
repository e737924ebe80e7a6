// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/solve/supernodes.hpp"

namespace hyperex::fem {

/// Solves with a supernodal factor for one right-hand side. The two halves of the elimination tree
/// (supernodes.hpp) are always solved separately, whatever the number of threads, so that the
/// results are reproducible.
class TriangularSolver {
 public:
  TriangularSolver() = default;
  /// The pattern must outlive the solver; values may change.
  explicit TriangularSolver(const Supernodes& factor);
  /// y := L^-T L^-1 y, with y in elimination order. Allocates nothing.
  void solve(const Supernodes& factor, double* y);

 private:
  std::vector<int> half_[2];  // supernodes of the halves, increasing
  std::vector<int> top_;      // supernodes above them, increasing
  std::vector<int> inner_;    // per supernode of a half: the number of its rows in that half
  std::vector<int> top_row_, top_index_;  // unknowns of the top; per unknown its place there
  std::vector<double> top_sum_[2];        // contributions of the halves to the top's unknowns
  std::vector<double> work_[2];
};

}  // namespace hyperex::fem
