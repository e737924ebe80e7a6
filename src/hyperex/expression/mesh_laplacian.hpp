// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <map>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The matrix L, |V| x |V|, with (L d)_i = d_i - mean of d over the neighbours of i. The row of a
/// vertex without triangles is zero.
SparseMatrix mesh_laplacian(const TriMesh& mesh);

/// The field d with d_v = fixed[v] that minimises d^T S d, where S is `smoothness`, |V| x |V|,
/// positive semidefinite. Returns one row per vertex. Throws std::logic_error if S is not positive
/// definite on the free vertices.
Points smooth_fill(const SparseMatrix& smoothness, const std::map<int, Vec3>& fixed);

}  // namespace hyperex::expression
