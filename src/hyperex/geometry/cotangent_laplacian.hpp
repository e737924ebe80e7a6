// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/SparseCore>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The Laplacian of a surface with the cotangent weights of Pinkall and Polthier (Exp. Math. 2,
/// 1993, 15), integrated over the area around each vertex: |V| x |V|, symmetric, positive
/// semidefinite. x^T L x is the Dirichlet energy of a field x that is linear in each triangle. On a
/// flat surface L x = 0 inside, for any linear x. A corner with an angle of less than 0.001, or as
/// close to 180 degrees, adds nothing.
Eigen::SparseMatrix<double> cotangent_laplacian(const TriMesh& mesh);

}  // namespace hyperex
