// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/solve/partitioned_factor.hpp"

namespace hyperex::fem {

/// The displacements of some nodes under unit forces on the same nodes: the rows and columns of
/// A_oo^-1 that belong to them. 3 n x 3 n (m/N for a stiffness), unknown 3 i + axis of `nodes[i]`;
/// symmetric; rows and columns of prescribed unknowns are 0. Where a Cholesky factor eliminates
/// these nodes last (order_with_last) it is read off it. Else it takes one solution a column, some
/// dozens at a time, so that no more than those are held.
Eigen::MatrixXd condensed_inverse(PartitionedFactor& factor, const std::vector<int>& nodes);

/// The order `known`, found where `known_prescribed` were prescribed, for other prescribed unknowns
/// (sorted) and so that `nodes` are eliminated last. Unknowns that were not free before come just
/// before those. What the factor takes is not counted anew.
NodeOrder order_with_last(const NodeOrder& known, const std::vector<int>& known_prescribed,
                          const std::vector<int>& prescribed, int unknowns,
                          const std::vector<int>& nodes);

}  // namespace hyperex::fem
