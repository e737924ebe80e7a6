// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/matching.hpp"

#include <cmath>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/sided_triangles.hpp"

namespace hyperex::simulate {
std::vector<Match> match(const Points& places, const TriMesh& tracked, const std::vector<int>& side,
                         const std::vector<int>& point_side) {
  const SurfaceTree tree(tracked);
  const SidedTriangles sided(tracked, side.empty() ? side : point_side);
  std::vector<Match> matches(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const std::vector<char>& part = sided.open_to(side.empty() ? 0 : side[std::size_t(i)]);
    const ClosestPoint c = tree.query_among(part, places.row(i).transpose());
    const int f = c.triangle;
    for (int k = 0; k < 3; ++k) matches[i].point[k] = tracked.triangles(f, k);
    matches[i].weight = c.weights;
    matches[i].distance_m = std::sqrt(c.squared_distance);
  }
  return matches;
}

}  // namespace hyperex::simulate
