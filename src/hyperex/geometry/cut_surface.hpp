// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/insert_line.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// A surface opened along a line. The given vertices keep their places; new ones are appended.
struct CutSurface {
  /// Row f is the given triangle f or one piece of it; its other pieces are appended.
  TriMesh mesh;
  std::vector<EdgePoint> appended;  ///< position of each appended vertex on the given mesh
  /// For each triangle, the given triangle that it equals or is a piece of.
  std::vector<int> source_triangle;
  std::vector<int> left_rim, right_rim;  ///< the two rims along the line; they share its ends
};

/// Opens `mesh` (manifold, oriented) along `path`. Every vertex between the ends is duplicated; the
/// triangles on the right of the path, seen from outside, get the copy. A path of fewer than three
/// vertices opens nothing. Throws std::invalid_argument if two successive vertices of the path are
/// not joined by an edge with a triangle on both sides, or if the path touches a border between its
/// ends.
CutSurface cut_along(const TriMesh& mesh, const std::vector<int>& path);

/// Opens `mesh` along `line`, which insert_line() projects onto the surface. The line may cross
/// triangles.
CutSurface cut_along_line(const TriMesh& mesh, const Points& line, const Vec3& towards_viewer);

}  // namespace hyperex
