// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

/// Edges that have one triangle only, as pairs of vertices, the lower first.
struct BorderEdges {
  std::vector<std::pair<int, int>> outline;   ///< of the longest connected piece: around the face
  std::vector<std::pair<int, int>> openings;  ///< of all others: eyes, mouth
};
BorderEdges border_edges(const TriMesh& mesh);

}  // namespace hyperex::expression
