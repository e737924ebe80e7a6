// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// An elimination order for a matrix whose unknowns are grouped by nodes, and the cost of a factor
/// with this order. It is found on the graph of nodes, which has a ninth of the entries. The
/// quality is the same as on the graph of unknowns, in a fraction of the time.
struct NodeOrder {
  std::vector<int> unknowns;  ///< the k-th to eliminate
  double entries = 0;         ///< in L, without the zeros stored in supernodes (about a fifth)
  double flops = 0;           ///< of one factorisation
};

/// `lower`: lower triangle with sorted columns and stored diagonal. `node_of[column]` must not
/// decrease. Uses nested dissection by METIS. Throws NumericalError if memory runs out.
NodeOrder order_by_nodes(const SparseMatrix& lower, const std::vector<int>& node_of);

/// Restricts an order of the unknowns that `prescribed` leaves free to those that `more` leaves
/// free. Both lists are sorted, and `more` must contain `prescribed`. The factor does not become
/// larger, so `entries` and `flops` are kept as upper bounds.
NodeOrder restricted(const NodeOrder& order, int unknowns, const std::vector<int>& prescribed,
                     const std::vector<int>& more);

}  // namespace hyperex::fem
