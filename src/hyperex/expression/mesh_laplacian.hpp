// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <map>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// |V| x |V|: (L d)_i = d_i - mean of d over the neighbours of i; a vertex without triangles has an
/// empty row.
SparseMatrix mesh_laplacian(const TriMesh& mesh);

/// The field d with d_v = fixed[v] that minimises d^T `smoothness` d (|V| x |V|, positive
/// semidefinite, definite on the free vertices: std::logic_error otherwise). One row per vertex.
Points smooth_fill(const SparseMatrix& smoothness, const std::map<int, Vec3>& fixed);

}  // namespace hyperex::expression
