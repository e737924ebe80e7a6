// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/solve/partitioned_factor.hpp"

namespace hyperex::fem {

/// The flexibility matrix of some nodes: their displacements under unit forces on the same nodes,
/// that is, the rows and columns of A_oo^-1 that belong to them. 3 n x 3 n (m/N if A is a
/// stiffness), with unknown 3 i + axis of `nodes[i]`; symmetric. Rows and columns of prescribed
/// unknowns are 0. If the Cholesky factor eliminates these nodes last (order_with_last), the matrix
/// follows directly from the factor. Otherwise each column takes one solution. The columns are
/// solved in groups of some dozens to limit the memory.
Eigen::MatrixXd condensed_inverse(PartitionedFactor& factor, const std::vector<int>& nodes);

/// Adapts the elimination order `known`, which belongs to `known_prescribed`, to other prescribed
/// unknowns (sorted), with `nodes` eliminated last. Unknowns that were not free before are
/// eliminated just before `nodes`. `entries` and `flops` are not recomputed.
NodeOrder order_with_last(const NodeOrder& known, const std::vector<int>& known_prescribed,
                          const std::vector<int>& prescribed, int unknowns,
                          const std::vector<int>& nodes);

}  // namespace hyperex::fem
