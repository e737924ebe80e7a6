// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <limits>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Shortest paths along the edges of a mesh (Dijkstra). The lists of neighbours are computed once.
class EdgePaths {
 public:
  explicit EdgePaths(const TriMesh& mesh);

  /// Length of the shortest path from the nearest of `seeds` to every vertex, in the unit of the
  /// mesh. Infinite if there is no path or if it is longer than `limit`.
  std::vector<double> distances(const std::vector<int>& seeds,
                                double limit = std::numeric_limits<double>::infinity()) const;

  /// The path with the least sum of `cost(a, b)` > 0 over its edges, including both ends; empty if
  /// there is none.
  std::vector<int> cheapest(int from, int to, const std::function<double(int, int)>& cost) const;

 private:
  Points points_;
  std::vector<std::vector<int>> around_;
};

/// Index of the point of `points` nearest to `p`; lowest index on ties.
int nearest_vertex(const Points& points, const Vec3& p);

}  // namespace hyperex
