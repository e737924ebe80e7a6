// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/partition.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/assert.hpp"
#include "hyperex/fem/material/entry.hpp"

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
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    require(prescribed[i] >= 0 && prescribed[i] < unknowns,
            "prescribed unknown {} is {}: expected 0 to {}", i, prescribed[i], unknowns - 1);
    require(
        i == 0 || prescribed[i] > prescribed[i - 1],
        "prescribed unknown {} is {} (node {}, axis {}), after {}: expected rising numbers, each "
        "once",
        i, prescribed[i], prescribed[i] / 3, "xyz"[prescribed[i] % 3], prescribed[i - 1]);
  }
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
  check_size("the lower triangle", lower.cols(), static_cast<Eigen::Index>(partition.free.size()));
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, partition.free.size(), 256), [&](const auto& range) {
        for (std::size_t c = range.begin(); c < range.end(); ++c) {
          const int column = partition.free[c], end = a.outerIndexPtr()[column + 1];
          double* out = lower.valuePtr() + lower.outerIndexPtr()[c];
          const double* const filled = lower.valuePtr() + lower.outerIndexPtr()[c + 1];
          const auto same = [&](bool holds) {
            require(holds, "column {} of the matrix has another pattern than before", column);
          };
          for (int k = a.outerIndexPtr()[column]; k < end; ++k)
            if (const int row = a.innerIndexPtr()[k];
                row >= column && partition.free_index[row] >= 0) {
              same(out < filled);
              *out++ = a.valuePtr()[k];
            }
          same(out == filled);
        }
      });
}

void check_matrix(std::string_view what, const SparseMatrix& a) {
  require(a.rows() == a.cols(), "{} is {} x {}: expected a square matrix", what, a.rows(),
          a.cols());
  if (a.isCompressed() && Eigen::Map<const Eigen::ArrayXd>(a.valuePtr(), a.nonZeros()).allFinite())
    return;
  for (int c = 0; c < a.outerSize(); ++c)
    for (SparseMatrix::InnerIterator it(a, c); it; ++it)
      require(std::isfinite(it.value()), "{} has {} at ({}, {}): expected finite numbers", what,
              it.value(), it.row(), c);
}

void check_system(const System& system) {
  check_matrix("System::stiffness", system.stiffness);
  check_matrix("System::damping", system.damping);
  check_matrix("System::mass", system.mass);
  for (const SparseMatrix* m : {&system.stiffness, &system.damping, &system.mass})
    require(m->isCompressed(), "System: a matrix is not compressed: call makeCompressed() before");
  const Eigen::Index n = system.stiffness.cols();
  require(n % 3 == 0, "System::stiffness has {} columns: expected three for each node", n);
  require(system.damping.cols() == n && system.mass.cols() == n,
          "System: stiffness, damping and mass have {}, {} and {} columns: expected as many each",
          n, system.damping.cols(), system.mass.cols());
  require(system.damping.nonZeros() == system.mass.nonZeros(),
          "System: damping has {} entries and mass {}: expected the same pattern",
          system.damping.nonZeros(), system.mass.nonZeros());
}

SparseMatrix coupling(const SparseMatrix& a, const Partition& partition) {
  return free_rows(a, partition, partition.prescribed, false);
}

SparseMatrix combined(const System& system, double damping_share, double mass_share) {
  check_system(system);
  SparseMatrix a = system.stiffness;
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    int at = a.outerIndexPtr()[column];
    for (int k = system.damping.outerIndexPtr()[column];
         k < system.damping.outerIndexPtr()[column + 1]; ++k) {
      const int row = system.damping.innerIndexPtr()[k], end = a.outerIndexPtr()[column + 1];
      while (at < end && a.innerIndexPtr()[at] < row) ++at;
      require(at < end && a.innerIndexPtr()[at] == row,
              "System::damping has an entry ({}, {}) that System::stiffness has not: expected its "
              "pattern within that of the stiffness",
              row, column);
      a.valuePtr()[at] +=
          damping_share * system.damping.valuePtr()[k] + mass_share * system.mass.valuePtr()[k];
    }
  }
  return a;
}

}  // namespace hyperex::fem
