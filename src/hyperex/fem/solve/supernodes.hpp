// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace hyperex::fem {

/// A supernodal factor L in CHOLMOD's format. Supernode s comprises the columns first[s] ..
/// first[s+1]-1. They are dense over the rows row[row_start[s] .. row_start[s+1]), of which its own
/// columns come first, and are stored column-major at value[value_start[s]].
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
  const int* rows;      // below the diagonal block, increasing
  const double* value;  // (columns + below) x columns
  int height() const { return columns + below; }
};

inline Panel panel(const Supernodes& f, int s) {
  const int columns = f.first[s + 1] - f.first[s], height = f.row_start[s + 1] - f.row_start[s];
  return {columns, height - columns, f.row + f.row_start[s] + columns, f.value + f.value_start[s]};
}

/// Parent of each supernode in the elimination tree: the supernode that contains its first row
/// below the diagonal block, or -1 for a root. A parent always has a greater number.
std::vector<int> parents(const Supernodes& f);

/// Divides the elimination tree into a top and two halves. The halves consist of subtrees that
/// share no unknown. Returns 0 or 1 for each supernode of a half, and -1 for the top. Starting at
/// the heaviest subtree, subtrees are opened until they can be distributed into two halves of
/// similar work. `work`: the cost of a supernode. Idea: tree parallelism of the multifrontal method
/// (Liu, SIAM Review 34, 1992).
std::vector<int> halves(const Supernodes& f, const std::vector<int>& parent,
                        const std::function<double(const Panel&)>& work);

}  // namespace hyperex::fem
