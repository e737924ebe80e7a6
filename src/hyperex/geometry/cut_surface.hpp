// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// A surface opened along a walk of its vertices.
struct CutSurface {
  TriMesh mesh;                      ///< triangles in the given order; duplicated vertices appended
  std::vector<int> duplicated_from;  ///< for each appended vertex, the vertex it was parted from
};

/// Opens `mesh` (manifold, oriented) along `path`: every vertex between its ends is doubled, the
/// triangles on the right of the walk (seen from outside) get the copy. A path of fewer than three
/// vertices opens nothing. Throws std::invalid_argument where two neighbours of the path share no
/// edge with a triangle on both sides.
CutSurface cut_along(const TriMesh& mesh, const std::vector<int>& path);

}  // namespace hyperex
