// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

/// The border edges of a mesh (edges with one triangle only), as pairs of vertices with the lower
/// index first.
struct BorderEdges {
  /// Edges of the longest connected border, around the face.
  std::vector<std::pair<int, int>> outline;
  std::vector<std::pair<int, int>> openings;  ///< edges of all other borders: eyes, mouth
};
BorderEdges border_edges(const TriMesh& mesh);

}  // namespace hyperex::expression
