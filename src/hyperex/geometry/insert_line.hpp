// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// A point on a mesh: a + t (b - a) on its edge (a, b), 0 <= t < 1. At a vertex, a = b and t = 0.
struct EdgePoint {
  int a = 0, b = 0;
  double t = 0;
  Vec3 on(const Points& points) const {
    return points.row(a).transpose() + t * (points.row(b) - points.row(a)).transpose();
  }
};

/// A surface into which a line has been inserted.
struct LinedSurface {
  /// The given vertices, then the appended ones; row f is the given triangle f or one piece of it;
  /// its other pieces are appended.
  TriMesh mesh;
  std::vector<EdgePoint> appended;  ///< position of each appended vertex on the given mesh
  /// For each triangle, the given triangle that it equals or is a piece of.
  std::vector<int> source_triangle;
  std::vector<int> path;  ///< the line as vertices; successive ones are joined by edges
};

/// Projects the polyline `line` onto `mesh` along the direction `towards_viewer` (unit) and makes
/// it a path along edges. A vertex is inserted wherever the line crosses an edge. If the crossing
/// is within 15 % of the edge's length from a vertex, that vertex is used instead, to avoid
/// slivers. If the surface is folded over itself, only the sheet that contains the ends of `line`
/// is used. The path ends at those vertices on the projected line that are closest to the ends of
/// `line`. `line` must lie within 15 % of its own length of the surface. Throws
/// std::invalid_argument if the line cannot be followed from end to end on the surface.
LinedSurface insert_line(const TriMesh& mesh, const Points& line, const Vec3& towards_viewer);

}  // namespace hyperex
