// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/node_blocks.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hyperex/core/assert.hpp"

namespace hyperex::fem {
namespace {

/// Rows of three of A x for columns from ... from + count - 1.
template <int count>
void rows_of(const int* column, const double* block, int blocks, const Columns& x, Columns& out,
             int node, Eigen::Index from) {
  const Eigen::Index stride = x.cols();
  double sum[3][count] = {};
  for (int k = 0; k < blocks; ++k, block += 9) {
    const double* p = x.data() + 3 * stride * column[k] + from;
    for (int axis = 0; axis < 3; ++axis, p += stride)
      for (int c = 0; c < count; ++c) {
        sum[0][c] += block[axis] * p[c];
        sum[1][c] += block[3 + axis] * p[c];
        sum[2][c] += block[6 + axis] * p[c];
      }
  }
  for (int row = 0; row < 3; ++row)
    for (int c = 0; c < count; ++c) out(3 * node + row, from + c) = sum[row][c];
}

}  // namespace

NodeBlocks::NodeBlocks(const SparseMatrix& a, const Partition& partition)
    : index_(partition.unknowns() / 3, -1) {
  HX_ASSERT(partition.unknowns() % 3 == 0);
  for (int n = 0; n < partition.unknowns() / 3; ++n) {
    const int* free = partition.free_index.data() + 3 * n;
    if (free[0] < 0 && free[1] < 0 && free[2] < 0) continue;
    index_[n] = node_count();
    nodes_.push_back(n);
    unknown_.insert(unknown_.end(), free, free + 3);
  }
  start_.assign(1, 0);
  for (const int n : nodes_) {
    for (int k = a.outerIndexPtr()[3 * n]; k < a.outerIndexPtr()[3 * n + 1]; k += 3) {
      HX_ASSERT(a.innerIndexPtr()[k] % 3 == 0);
      const int other = index_[a.innerIndexPtr()[k] / 3];
      if (other >= 0) column_.push_back(other);
    }
    start_.push_back(static_cast<int>(column_.size()));
  }
  value_.resize(9 * column_.size());
  refill(a);
}

void NodeBlocks::refill(const SparseMatrix& a) {
  tbb::parallel_for(0, node_count(), [&](int i) {
    const int* outer = a.outerIndexPtr() + 3 * nodes_[i];
    const int blocks = (outer[1] - outer[0]) / 3;
    double* out = value_.data() + 9 * static_cast<std::size_t>(start_[i]);
    for (int b = 0; b < blocks; ++b) {
      const int other = index_[a.innerIndexPtr()[outer[0] + 3 * b] / 3];
      if (other < 0) continue;
      for (int row = 0; row < 3; ++row)
        for (int axis = 0; axis < 3; ++axis) {
          // Symmetric: column `row` of the node is its row.
          const double value = a.valuePtr()[outer[row] + 3 * b + axis];
          const bool both = unknown_[3 * i + row] >= 0 && unknown_[3 * other + axis] >= 0;
          *out++ = both || (i == other && row == axis) ? value : 0;
        }
    }
  });
}

void NodeBlocks::product(const Columns& x, Columns& out) const {
  const Eigen::Index count = x.cols();
  tbb::parallel_for(tbb::blocked_range<int>(0, node_count(), 256), [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const int blocks = start_[i + 1] - start_[i];
      const int* column = column_.data() + start_[i];
      const double* values = block(start_[i]);
      Eigen::Index from = 0;
      for (; from + 8 <= count; from += 8) rows_of<8>(column, values, blocks, x, out, i, from);
      for (; from + 4 <= count; from += 4) rows_of<4>(column, values, blocks, x, out, i, from);
      for (; from < count; ++from) rows_of<1>(column, values, blocks, x, out, i, from);
    }
  });
}

}  // namespace hyperex::fem
