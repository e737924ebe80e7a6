// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/fem/form/lists.hpp"
#include "hyperex/fem/solve/node_blocks.hpp"

namespace hyperex::fem {

/// The nodes of a matrix in overlapping subdomains.
struct Subdomains {
  Lists nodes;                 ///< of each subdomain, rising
  std::vector<double> weight;  ///< per entry of `nodes`: sums to 1 over the subdomains of a node
};

/// `points`: one row a node of the blocks. Halved along the longest side of the bounding box until
/// the parts have about `target` nodes, then grown by the nodes that the matrix couples to them. A
/// node's weight in the subdomain it came from is twice that in each of the others.
Subdomains overlapping_subdomains(const NodeBlocks& a, const Points& points, int target);

}  // namespace hyperex::fem
