// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

#include "hyperex/fem/form/assembler.hpp"

namespace hyperex::fem {

/// The rotation of the tissue at a node displaced by d (3 |nodes|, m): the orthogonal polar factor
/// of the mean deformation gradient around the node, weighted by volume, by Higham's iteration
/// (SIAM J. Sci. Stat. Comput. 7, 1986). `last` is returned if the mean gradient has no positive
/// determinant. Accurate to 1e-10.
Eigen::Matrix3d node_rotation(const Assembler& assembler, const Eigen::VectorXd& d, int node,
                              const Eigen::Matrix3d& last);

}  // namespace hyperex::fem
