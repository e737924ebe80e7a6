// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>

#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

using SparseMatrix = Eigen::SparseMatrix<double>;  // column-major, both triangles stored

/// K d + C d' + M d'' = f over 3 |nodes| unknowns, unknown 3 n + axis.
/// The three matrices share one sparsity pattern.
struct System {
  SparseMatrix stiffness, damping, mass;
};

/// Linear tetrahedra, consistent mass. Throws NumericalError naming the first element whose volume
/// is not positive; InputError-worthy values (E <= 0 ...) must have been refused before: asserted.
System assemble(const Points& nodes, const Tetrahedra& tets, const Material& material);

/// Per element at displacement `d` (|nodes| x 3): strain (|T| x 6) and von Mises stress (Pa).
Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> element_strain(const Points& nodes,
                                                                         const Tetrahedra& tets,
                                                                         const Points& d);
Eigen::VectorXd von_mises_pa(const Points& nodes, const Tetrahedra& tets, const Material& material,
                             const Points& d);

}  // namespace hyperex::fem
