// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/solve/partitioned_factor.hpp"

namespace hyperex::fem {

/// The displacements of some nodes under unit forces on the same nodes: the rows and columns of
/// A_oo^-1 that belong to them. 3 n x 3 n (m/N for a stiffness), unknown 3 i + axis of `nodes[i]`;
/// symmetric; rows and columns of prescribed unknowns are 0. Takes one solution a column, some
/// dozens at a time, so that no more than those are held.
Eigen::MatrixXd condensed_inverse(PartitionedFactor& factor, const std::vector<int>& nodes);

}  // namespace hyperex::fem
