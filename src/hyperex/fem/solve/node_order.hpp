// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// An order of elimination for a matrix whose unknowns come in nodes, and what a factor in it
/// takes. Found on the graph of nodes, which has a ninth of the entries: the same quality in a
/// fraction of the time.
struct NodeOrder {
  std::vector<int> unknowns;  ///< the k-th to eliminate
  double entries = 0;         ///< of L, without the zeros that supernodes add (about a fifth)
  double flops = 0;           ///< of one factorisation
};

/// `lower`: lower triangle with columns sorted and diagonal stored; `node_of[column]` never falls.
/// Nested dissection by METIS. Throws NumericalError where memory runs out.
NodeOrder order_by_nodes(const SparseMatrix& lower, const std::vector<int>& node_of);

/// `order` is of the unknowns that `prescribed` leaves free; the same for those that are free where
/// `more` are prescribed (both sorted, the second holds the first). No factor takes more for it;
/// `entries` and `flops` stay as bounds.
NodeOrder restricted(const NodeOrder& order, int unknowns, const std::vector<int>& prescribed,
                     const std::vector<int>& more);

}  // namespace hyperex::fem
