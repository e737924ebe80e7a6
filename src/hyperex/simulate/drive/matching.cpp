// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/matching.hpp"

#include <cmath>

#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::simulate {
namespace {

/// The triangles that hold no point of side `barred`; empty where that is none.
std::vector<char> triangles_without(const TriMesh& tracked, const std::vector<int>& point_side,
                                    int barred) {
  std::vector<char> keep(static_cast<std::size_t>(tracked.triangles.rows()), 1);
  bool any = false;
  for (int f = 0; f < tracked.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) keep[f] &= point_side[tracked.triangles(f, k)] != barred;
    any |= keep[f] != 0;
  }
  return any ? keep : std::vector<char>();
}

}  // namespace

std::vector<Match> match(const Points& places, const TriMesh& tracked, const std::vector<int>& side,
                         const std::vector<int>& point_side) {
  const SurfaceTree tree(tracked);
  std::vector<char> without_upper, without_lower;
  if (!side.empty()) {
    without_upper = triangles_without(tracked, point_side, 1);
    without_lower = triangles_without(tracked, point_side, -1);
  }
  const std::vector<char> whole(static_cast<std::size_t>(tracked.triangles.rows()), 1);
  std::vector<Match> matches(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const std::vector<char>* part = &whole;
    if (!side.empty() && side[i] > 0 && !without_lower.empty()) part = &without_lower;
    if (!side.empty() && side[i] < 0 && !without_upper.empty()) part = &without_upper;
    const ClosestPoint c = tree.query_among(*part, places.row(i).transpose());
    const int f = c.triangle;
    for (int k = 0; k < 3; ++k) matches[i].point[k] = tracked.triangles(f, k);
    matches[i].weight = c.weights;
    matches[i].distance_m = std::sqrt(c.squared_distance);
  }
  return matches;
}

}  // namespace hyperex::simulate
