// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/partition.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "hyperex/core/assert.hpp"

namespace hyperex::fem {
namespace {

SparseMatrix free_rows(const SparseMatrix& a, const Partition& partition,
                       const std::vector<int>& columns, bool lower) {
  const auto first_kept = [&](SparseMatrix::InnerIterator& it, int column) {
    while (it && lower && it.row() < column) ++it;
  };
  SparseMatrix part(partition.free.size(), columns.size());
  int kept = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    SparseMatrix::InnerIterator it(a, columns[c]);
    for (first_kept(it, columns[c]); it; ++it) kept += partition.free_index[it.row()] >= 0;
    part.outerIndexPtr()[c + 1] = kept;
  }
  part.resizeNonZeros(kept);
  int filled = 0;
  for (const int column : columns) {
    SparseMatrix::InnerIterator it(a, column);
    for (first_kept(it, column); it; ++it) {
      const int row = partition.free_index[it.row()];
      if (row < 0) continue;
      part.innerIndexPtr()[filled] = row;
      part.valuePtr()[filled++] = it.value();
    }
  }
  return part;
}

}  // namespace

Partition::Partition(int unknowns, std::vector<int> prescribed_)
    : prescribed(std::move(prescribed_)), free_index(unknowns, 0) {
  HX_ASSERT(std::is_sorted(prescribed.begin(), prescribed.end()));
  HX_ASSERT(prescribed.empty() || (prescribed.front() >= 0 && prescribed.back() < unknowns));
  for (const int c : prescribed) free_index[c] = -1;
  for (int i = 0; i < unknowns; ++i)
    if (free_index[i] == 0) {
      free_index[i] = static_cast<int>(free.size());
      free.push_back(i);
    }
  HX_ASSERT(free.size() + prescribed.size() == free_index.size());
}

SparseMatrix free_lower(const SparseMatrix& a, const Partition& partition) {
  return free_rows(a, partition, partition.free, true);
}

void refill_free_lower(const SparseMatrix& a, const Partition& partition, SparseMatrix& lower) {
  HX_ASSERT(lower.cols() == static_cast<Eigen::Index>(partition.free.size()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, partition.free.size(), 256),
                    [&](const auto& range) {
                      for (std::size_t c = range.begin(); c < range.end(); ++c) {
                        const int column = partition.free[c], end = a.outerIndexPtr()[column + 1];
                        double* out = lower.valuePtr() + lower.outerIndexPtr()[c];
                        for (int k = a.outerIndexPtr()[column]; k < end; ++k)
                          if (const int row = a.innerIndexPtr()[k];
                              row >= column && partition.free_index[row] >= 0)
                            *out++ = a.valuePtr()[k];
                        HX_ASSERT(out == lower.valuePtr() + lower.outerIndexPtr()[c + 1]);
                      }
                    });
}

SparseMatrix coupling(const SparseMatrix& a, const Partition& partition) {
  return free_rows(a, partition, partition.prescribed, false);
}

SparseMatrix combined(const System& system, double damping_share, double mass_share) {
  HX_ASSERT(system.damping.nonZeros() == system.mass.nonZeros());
  SparseMatrix a = system.stiffness;
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    int at = a.outerIndexPtr()[column];
    for (int k = system.damping.outerIndexPtr()[column];
         k < system.damping.outerIndexPtr()[column + 1]; ++k) {
      while (a.innerIndexPtr()[at] < system.damping.innerIndexPtr()[k]) ++at;
      HX_ASSERT(at < a.outerIndexPtr()[column + 1]);
      a.valuePtr()[at] +=
          damping_share * system.damping.valuePtr()[k] + mass_share * system.mass.valuePtr()[k];
    }
  }
  return a;
}

}  // namespace hyperex::fem
