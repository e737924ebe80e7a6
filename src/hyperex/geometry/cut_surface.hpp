// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/insert_line.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// A surface opened along a line. The given vertices keep their places; new ones are appended.
struct CutSurface {
  TriMesh mesh;  ///< row f of the given triangles is itself or one piece of it, its other pieces
                 ///< are appended
  std::vector<EdgePoint> appended;       ///< where each appended vertex lies on the given mesh
  std::vector<int> source_triangle;      ///< of each triangle, the given one it is (a piece of)
  std::vector<int> left_rim, right_rim;  ///< along the line, ends included and shared
};

/// Opens `mesh` (manifold, oriented) along `path`: every vertex between its ends is doubled, the
/// triangles on the right of the walk (seen from outside) get the copy. A path of fewer than three
/// vertices opens nothing. Throws std::invalid_argument where two neighbours of the path share no
/// edge with a triangle on both sides.
CutSurface cut_along(const TriMesh& mesh, const std::vector<int>& path);

/// Opens `mesh` along `line` as insert_line lays it on the surface, across triangles.
CutSurface cut_along_line(const TriMesh& mesh, const Points& line, const Vec3& towards_viewer);

}  // namespace hyperex
