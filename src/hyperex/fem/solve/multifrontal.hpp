// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/fem/solve/supernodes.hpp"

namespace hyperex::fem {

/// Numerical factorisation of a supernodal factor by the multifrontal method. Each supernode adds
/// up the contributions of its children in the elimination tree and eliminates its own columns. The
/// remaining Schur complement, a dense matrix over the rows below, is its contribution to its
/// parent. The two halves of the tree are always factored separately, whatever the number of
/// threads, so that the results are reproducible; in the top of the tree, large dense products are
/// divided in two. CHOLMOD's own factorisation updates all affected supernodes from each supernode,
/// which takes many more and smaller products. Source: Liu, The multifrontal method for sparse
/// matrix solution, SIAM Review 34 (1992).
class Multifrontal {
 public:
  Multifrontal() = default;
  /// `pattern`: that of the factor; must outlive this object. `order`: the k-th column to
  /// eliminate. `lower`: a matrix with the pattern of the lower triangle to be factored.
  Multifrontal(const Supernodes& pattern, const int* order, const SparseMatrix& lower);

  /// Writes L to `value` (laid out as the pattern states). `lower`: values on the pattern given to
  /// the constructor. Returns -1 on success, otherwise the column, in elimination order, at which
  /// the matrix is not positive definite. Allocates nothing.
  int factorize(const Supernodes& pattern, const SparseMatrix& lower, double* value);

 private:
  struct Entries {  // entries of the matrix, sorted by supernode
    std::vector<int> start;
    std::vector<int> from;   // place in the matrix
    std::vector<int> place;  // place within the panel
  };
  struct Run;  // data of one factorisation
  void map_entries(const Supernodes& f, const int* order, const SparseMatrix& lower);
  void map_children(const Supernodes& f);
  void lay_out_stacks(const Supernodes& f);
  double* left_over(int s) { return stack_[stack_of_[s]].data() + offset_[s]; }

  std::vector<int> parent_, half_;
  std::vector<std::vector<int>> children_;
  std::vector<int> by_half_[2], top_;  // increasing
  Entries entries_;
  std::vector<int> relative_start_, relative_;  // positions of a child's rows in its parent's panel
  // The contribution of a supernode stays on a stack until its parent is processed. Each half and
  // the top have two stacks, for even and odd depths in the tree: a parent reads from one stack and
  // writes to the other. On each stack, the last contribution is used first.
  std::vector<double> stack_[6];
  std::vector<int> stack_of_;
  std::vector<std::ptrdiff_t> offset_;
};

}  // namespace hyperex::fem
