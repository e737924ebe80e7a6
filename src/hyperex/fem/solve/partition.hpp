// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// The unknowns of a system split into prescribed (c) and free (o).
struct Partition {
  std::vector<int> prescribed, free;  ///< unknowns, sorted
  std::vector<int> free_index;        ///< per unknown: its position in `free`, or -1 if prescribed

  /// `prescribed`: sorted unique unknowns below `unknowns`. Throws InputError naming the first
  /// wrong one.
  Partition(int unknowns, std::vector<int> prescribed);
  int unknowns() const { return static_cast<int>(free_index.size()); }
};

/// Throws InputError if the matrix is not square or if an entry is not a finite number.
void check_matrix(std::string_view what, const SparseMatrix& a);
/// Checks all three matrices of a system, and that their sizes agree.
void check_system(const System& system);

/// Lower triangle of A_oo (rows and columns of the free unknowns).
SparseMatrix free_lower(const SparseMatrix& a, const Partition& partition);
/// The same, written to a matrix that free_lower() made for this pattern. Allocates nothing.
/// Parallel.
void refill_free_lower(const SparseMatrix& a, const Partition& partition, SparseMatrix& lower);
/// A_oc (rows of the free, columns of the prescribed unknowns).
SparseMatrix coupling(const SparseMatrix& a, const Partition& partition);
/// K + damping_share C + mass_share M; the pattern of K contains that of C and M.
SparseMatrix combined(const System& system, double damping_share, double mass_share);

}  // namespace hyperex::fem
