// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// A point of a mesh: a + t (b - a) on its edge (a, b), 0 <= t < 1; a = b and t = 0 at a vertex.
struct EdgePoint {
  int a = 0, b = 0;
  double t = 0;
  Vec3 on(const Points& points) const {
    return points.row(a).transpose() + t * (points.row(b) - points.row(a)).transpose();
  }
};

/// A surface with a line drawn into it.
struct LinedSurface {
  TriMesh mesh;  ///< the given vertices, then the appended; row f of the given triangles is itself
                 ///< or one piece of it, its other pieces are appended
  std::vector<EdgePoint> appended;   ///< where each appended vertex lies on the given mesh
  std::vector<int> source_triangle;  ///< of each triangle, the given one it is (a piece of)
  std::vector<int> path;             ///< the line: vertices, neighbours joined by edges
};

/// Lays the polyline `line` on `mesh` along the direction `towards_viewer` (unit) and makes it a
/// walk along edges: a vertex is put where it crosses an edge, unless it does so within 15 % of the
/// edge from a vertex, which is then used itself, so that no slivers come about. On the surface
/// folded over itself only the sheet is taken on which the ends of `line` lie; the walk ends at its
/// vertices nearest to them. `line` must lie within 15 % of its own length of the surface. Throws
/// std::invalid_argument where the line cannot be followed from end to end without leaving the
/// surface.
LinedSurface insert_line(const TriMesh& mesh, const Points& line, const Vec3& towards_viewer);

}  // namespace hyperex
