// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
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

/// One supernode: its diagonal block and the rows below it.
struct Panel {
  int columns, below;
  const int* rows;      // below the diagonal block, rising
  const double* value;  // (columns + below) x columns
  int height() const { return columns + below; }
};

inline Panel panel(const Supernodes& f, int s) {
  const int columns = f.first[s + 1] - f.first[s], height = f.row_start[s + 1] - f.row_start[s];
  return {columns, height - columns, f.row + f.row_start[s] + columns, f.value + f.value_start[s]};
}

/// Parent of each supernode in the elimination tree, always of a greater number: the supernode that
/// holds its first row below the diagonal block; -1: a root.
std::vector<int> parents(const Supernodes& f);

/// The elimination tree cut into a top and two halves of subtrees that share no unknown: for each
/// supernode 0 or 1, or -1 in the top. Subtrees are opened from the heaviest down until two even
/// heaps can be made of them. `work`: what a supernode costs. Source of the idea: tree parallelism
/// of the multifrontal method (Liu, SIAM Review 34, 1992).
std::vector<int> halves(const Supernodes& f, const std::vector<int>& parent,
                        const std::function<double(const Panel&)>& work);

}  // namespace hyperex::fem
