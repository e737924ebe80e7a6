// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace hyperex::fem {

/// A supernodal factor L as CHOLMOD stores it. Supernode s holds the columns first[s] ..
/// first[s+1]-1, dense over the rows row[row_start[s] .. row_start[s+1]) (its own columns first),
/// column-major at value[value_start[s]].
struct Supernodes {
  int count = 0, columns = 0;
  const int* first = nullptr;
  const int* row_start = nullptr;
  const int* value_start = nullptr;
  const int* row = nullptr;
  const double* value = nullptr;
};

/// Solves with a supernodal factor for one right-hand side. The elimination tree is cut into a top
/// and two halves of subtrees that share no unknown: the halves are solved side by side, whatever
/// the number of threads, so that the sums never change. Source of the idea: multifrontal tree
/// parallelism (Liu, SIAM Review 34, 1992).
class TriangularSolver {
 public:
  TriangularSolver() = default;
  /// The pattern must outlive the solver; values may change.
  explicit TriangularSolver(const Supernodes& factor);
  /// y := L^-T L^-1 y, y in the factor's order. Allocates nothing.
  void solve(const Supernodes& factor, double* y);

 private:
  std::vector<int> half_[2];  // supernodes of the halves, rising
  std::vector<int> top_;      // supernodes above them, rising
  std::vector<int> inner_;    // per supernode of a half: how many of its rows lie in that half
  std::vector<int> top_row_, top_index_;  // unknowns of the top; per unknown its place there
  std::vector<double> top_sum_[2];        // what the halves add to the top's unknowns
  std::vector<double> work_[2];
};

}  // namespace hyperex::fem
