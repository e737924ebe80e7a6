// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cholmod.h>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/fem/solve/supernodes.hpp"

namespace hyperex::fem {

/// A lower triangle in CHOLMOD's format. It refers to the caller's arrays, which must outlive it.
/// `start` has `columns` + 1 entries; `row` holds increasing rows without gaps; a null `value`
/// denotes a pattern only.
inline cholmod_sparse cholmod_view(Eigen::Index columns, const int* start, const int* row,
                                   const double* value) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(columns);
  view.nzmax = static_cast<std::size_t>(start[columns]);
  view.p = const_cast<int*>(start);
  view.i = const_cast<int*>(row);
  view.x = const_cast<double*>(value);
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = value ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}
inline cholmod_sparse cholmod_view(const SparseMatrix& lower) {
  return cholmod_view(lower.cols(), lower.outerIndexPtr(), lower.innerIndexPtr(), lower.valuePtr());
}

/// The supernodes of a numerical factor. They refer to CHOLMOD's memory.
inline Supernodes supernodes_of(const cholmod_factor& factor) {
  Supernodes s;
  s.count = static_cast<int>(factor.nsuper);
  s.columns = static_cast<int>(factor.n);
  s.first = static_cast<const int*>(factor.super);
  s.row_start = static_cast<const int*>(factor.pi);
  s.value_start = static_cast<const int*>(factor.px);
  s.row = static_cast<const int*>(factor.s);
  s.value = static_cast<const double*>(factor.x);
  return s;
}

}  // namespace hyperex::fem
