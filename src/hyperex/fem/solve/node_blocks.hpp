// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/solve/partition.hpp"

namespace hyperex::fem {

/// Several vectors side by side, so that one matrix entry meets neighbouring numbers.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A_oo in blocks of 3 x 3 over the nodes that have a free unknown. Prescribed axes of such nodes
/// have rows and columns of the identity (times their own diagonal entry), so that every node has
/// three unknowns here.
class NodeBlocks {
 public:
  NodeBlocks(const SparseMatrix& a, const Partition& partition);
  /// Other values on the same pattern.
  void refill(const SparseMatrix& a);

  int node_count() const { return static_cast<int>(nodes_.size()); }
  int size() const { return 3 * node_count(); }
  const std::vector<int>& nodes() const { return nodes_; }      ///< of the mesh, rising
  const std::vector<int>& unknown() const { return unknown_; }  ///< free index per row, -1: none
  int row_start(int node) const { return start_[node]; }
  const int* columns() const { return column_.data(); }
  /// Row-major 3 x 3.
  const double* block(int k) const { return value_.data() + 9 * static_cast<std::size_t>(k); }

  /// out := A x. Each row is summed by one thread in its own order.
  void product(const Columns& x, Columns& out) const;

 private:
  std::vector<int> nodes_, unknown_, start_, column_;
  std::vector<int> index_;  // mesh node -> place in nodes_ or -1
  std::vector<double> value_;
};

}  // namespace hyperex::fem
