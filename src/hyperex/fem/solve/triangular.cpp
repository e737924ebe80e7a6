// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/triangular.hpp"

#include <tbb/parallel_invoke.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstddef>
#include <numeric>

namespace hyperex::fem {
namespace {

using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using Segment = Eigen::Map<Eigen::VectorXd>;

struct Panel {
  int columns, below;
  const int* rows;  // below the diagonal block
  Block diagonal, under;
};

Panel panel(const Supernodes& f, int s) {
  const int columns = f.first[s + 1] - f.first[s], height = f.row_start[s + 1] - f.row_start[s];
  const double* value = f.value + f.value_start[s];
  return {columns, height - columns, f.row + f.row_start[s] + columns,
          Block(value, columns, columns, Eigen::OuterStride<>(height)),
          Block(value + columns, height - columns, columns, Eigen::OuterStride<>(height))};
}

/// Parent of each supernode: the one that holds its first row below the diagonal block; -1: root.
std::vector<int> parents(const Supernodes& f) {
  std::vector<int> holder(f.columns), parent(f.count, -1);
  for (int s = 0; s < f.count; ++s)
    std::fill(holder.begin() + f.first[s], holder.begin() + f.first[s + 1], s);
  for (int s = 0; s < f.count; ++s) {
    const Panel p = panel(f, s);
    if (p.below > 0) parent[s] = holder[p.rows[0]];
  }
  return parent;
}

/// Which half each supernode belongs to; -1: the top. Subtrees are opened from the heaviest down
/// until two heaps of them can be made even.
std::vector<int> halves(const Supernodes& f, const std::vector<int>& parent) {
  std::vector<double> weight(f.count);  // of the whole subtree
  std::vector<std::vector<int>> children(f.count);
  std::vector<int> subtrees;
  for (int s = 0; s < f.count; ++s) {
    const Panel p = panel(f, s);
    weight[s] += (p.below + 0.5 * p.columns) * p.columns;
    if (parent[s] < 0) {
      subtrees.push_back(s);
    } else {
      weight[parent[s]] += weight[s];
      children[parent[s]].push_back(s);
    }
  }
  std::vector<int> half_of_root(f.count, -1);
  const auto share_out = [&] {
    double heap[2] = {0, 0};
    std::sort(subtrees.begin(), subtrees.end(),
              [&](int a, int b) { return weight[a] != weight[b] ? weight[a] > weight[b] : a < b; });
    for (const int s : subtrees) {
      half_of_root[s] = heap[1] < heap[0];
      heap[half_of_root[s]] += weight[s];
    }
    return std::max(heap[0], heap[1]) <= 0.53 * (heap[0] + heap[1]);
  };
  while (!subtrees.empty() && !share_out()) {
    const int heaviest = subtrees.front();
    half_of_root[heaviest] = -1;
    subtrees.erase(subtrees.begin());
    subtrees.insert(subtrees.end(), children[heaviest].begin(), children[heaviest].end());
  }
  std::vector<int> half(f.count, -1);
  for (int s = f.count - 1; s >= 0; --s)
    half[s] = half_of_root[s] >= 0 ? half_of_root[s] : parent[s] >= 0 ? half[parent[s]] : -1;
  return half;
}

}  // namespace

TriangularSolver::TriangularSolver(const Supernodes& f)
    : inner_(f.count, 0), top_index_(f.columns, -1) {
  const std::vector<int> half = halves(f, parents(f));
  for (int s = 0; s < f.count; ++s) {
    (half[s] < 0 ? top_ : half_[half[s]]).push_back(s);
    if (half[s] >= 0) continue;
    for (int k = f.first[s]; k < f.first[s + 1]; ++k) {
      top_index_[k] = static_cast<int>(top_row_.size());
      top_row_.push_back(k);
    }
  }
  std::size_t tallest = 0;
  for (int s = 0; s < f.count; ++s) {
    const Panel p = panel(f, s);
    tallest = std::max(tallest, static_cast<std::size_t>(p.below));
    // Rows rise towards the root, so that those of the top come last.
    if (half[s] >= 0)
      inner_[s] = static_cast<int>(
          std::find_if(p.rows, p.rows + p.below, [&](int r) { return top_index_[r] >= 0; }) -
          p.rows);
  }
  for (int h = 0; h < 2; ++h) {
    top_sum_[h].assign(top_row_.size(), 0.0);
    work_[h].assign(tallest, 0.0);
  }
}

void TriangularSolver::solve(const Supernodes& f, double* y) {
  const auto forward_half = [&](int h) {
    std::fill(top_sum_[h].begin(), top_sum_[h].end(), 0.0);
    for (const int s : half_[h]) {
      const Panel p = panel(f, s);
      Segment x(y + f.first[s], p.columns), sum(work_[h].data(), p.below);
      p.diagonal.triangularView<Eigen::Lower>().solveInPlace(x);
      sum.noalias() = p.under * x;
      for (int i = 0; i < inner_[s]; ++i) y[p.rows[i]] -= sum[i];
      for (int i = inner_[s]; i < p.below; ++i) top_sum_[h][top_index_[p.rows[i]]] += sum[i];
    }
  };
  tbb::parallel_invoke([&] { forward_half(0); }, [&] { forward_half(1); });
  for (std::size_t i = 0; i < top_row_.size(); ++i)
    y[top_row_[i]] -= top_sum_[0][i] + top_sum_[1][i];
  for (const int s : top_) {
    const Panel p = panel(f, s);
    Segment x(y + f.first[s], p.columns), sum(work_[0].data(), p.below);
    p.diagonal.triangularView<Eigen::Lower>().solveInPlace(x);
    sum.noalias() = p.under * x;
    for (int i = 0; i < p.below; ++i) y[p.rows[i]] -= sum[i];
  }
  const auto backward = [&](int s, int h) {
    const Panel p = panel(f, s);
    Segment x(y + f.first[s], p.columns), above(work_[h].data(), p.below);
    for (int i = 0; i < p.below; ++i) above[i] = y[p.rows[i]];
    x.noalias() -= p.under.transpose() * above;
    p.diagonal.transpose().triangularView<Eigen::Upper>().solveInPlace(x);
  };
  for (auto s = top_.rbegin(); s != top_.rend(); ++s) backward(*s, 0);
  const auto backward_half = [&](int h) {
    for (auto s = half_[h].rbegin(); s != half_[h].rend(); ++s) backward(*s, h);
  };
  tbb::parallel_invoke([&] { backward_half(0); }, [&] { backward_half(1); });
}

}  // namespace hyperex::fem
