// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// The unknowns of a system split into prescribed (c) and free (o).
struct Partition {
  std::vector<int> prescribed, free;  ///< unknowns, sorted
  std::vector<int> free_index;        ///< per unknown: its place in `free`, -1 where prescribed

  /// `prescribed`: sorted unique unknowns below `unknowns`; else InputError naming the first that
  /// is not.
  Partition(int unknowns, std::vector<int> prescribed);
  int unknowns() const { return static_cast<int>(free_index.size()); }
};

/// Throws InputError where a matrix is not square or an entry is no finite number.
void check_matrix(std::string_view what, const SparseMatrix& a);
/// The same of all three, and where their sizes do not fit each other.
void check_system(const System& system);

/// Lower triangle of A_oo, the free rows of the free columns.
SparseMatrix free_lower(const SparseMatrix& a, const Partition& partition);
/// The same into a matrix that free_lower() made of this pattern: allocates nothing. Parallel.
void refill_free_lower(const SparseMatrix& a, const Partition& partition, SparseMatrix& lower);
/// A_oc, the free rows of the prescribed columns.
SparseMatrix coupling(const SparseMatrix& a, const Partition& partition);
/// K + damping_share C + mass_share M; the pattern of K contains that of C and M.
SparseMatrix combined(const System& system, double damping_share, double mass_share);

}  // namespace hyperex::fem
