// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/fem/solve/supernodes.hpp"

namespace hyperex::fem {

/// Numbers of a supernodal factor by the multifrontal method: each supernode sums what its children
/// in the elimination tree leave to it, eliminates its own columns and leaves the rest, a dense
/// matrix over the rows below, to its parent. Both halves of the tree are factored side by side,
/// whatever the number of threads, so that the numbers never change; in the top, the large dense
/// products are parted in two. CHOLMOD's own factorisation goes from one supernode to all that it
/// changes, which takes many more and smaller products. Source: Liu, The multifrontal method for
/// sparse matrix solution, SIAM Review 34 (1992).
class Multifrontal {
 public:
  Multifrontal() = default;
  /// `pattern`: of the factor; must outlive this. `order`: the k-th column to eliminate. `lower`:
  /// the pattern of the lower triangle that is factored.
  Multifrontal(const Supernodes& pattern, const int* order, const SparseMatrix& lower);

  /// Writes L to `value` (laid out as the pattern says). `lower`: values on the pattern given
  /// above. Returns -1, or the column in elimination order where the matrix is not positive
  /// definite. Allocates nothing.
  int factorize(const Supernodes& pattern, const SparseMatrix& lower, double* value);

 private:
  struct Entries {  // of the matrix, by the supernode that they belong to
    std::vector<int> start;
    std::vector<int> from;   // place in the matrix
    std::vector<int> place;  // place within the panel
  };
  struct Run;  // what one factorisation needs beside
  void map_entries(const Supernodes& f, const int* order, const SparseMatrix& lower);
  void map_children(const Supernodes& f);
  void lay_out_stacks(const Supernodes& f);
  double* left_over(int s) { return stack_[stack_of_[s]].data() + offset_[s]; }

  std::vector<int> parent_, half_;
  std::vector<std::vector<int>> children_;
  std::vector<int> by_half_[2], top_;  // rising
  Entries entries_;
  std::vector<int> relative_start_, relative_;  // of a child's rows in its parent's panel
  // What a supernode leaves waits on a stack until its parent is reached. A half and the top have
  // two stacks each, for even and odd depth in the tree: a parent writes to one what it sums from
  // the other, and on each the last come is the first taken.
  std::vector<double> stack_[6];
  std::vector<int> stack_of_;
  std::vector<std::ptrdiff_t> offset_;
};

}  // namespace hyperex::fem
