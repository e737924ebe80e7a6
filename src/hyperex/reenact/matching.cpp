// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/matching.hpp"

#include <cmath>
#include <memory>

#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::reenact {
namespace {

/// The tracked triangles without those that hold a point of side `barred`.
struct Part {
  std::vector<int> triangle;  // rows of the whole mesh
  std::unique_ptr<SurfaceTree> tree;
};

Part part_without(const TriMesh& tracked, const std::vector<int>& point_side, int barred) {
  Part part;
  for (int f = 0; f < tracked.triangles.rows(); ++f) {
    bool keep = true;
    if (barred != 0)
      for (int k = 0; k < 3; ++k) keep &= point_side[tracked.triangles(f, k)] != barred;
    if (keep) part.triangle.push_back(f);
  }
  TriMesh mesh{tracked.points, Triangles(part.triangle.size(), 3)};
  for (std::size_t i = 0; i < part.triangle.size(); ++i)
    mesh.triangles.row(i) = tracked.triangles.row(part.triangle[i]);
  if (!part.triangle.empty()) part.tree = std::make_unique<SurfaceTree>(mesh);
  return part;
}

}  // namespace

std::vector<Match> match(const Points& places, const TriMesh& tracked, const std::vector<int>& side,
                         const std::vector<int>& point_side) {
  const Part whole = part_without(tracked, point_side, 0);
  Part without_upper, without_lower;
  if (!side.empty()) {
    without_upper = part_without(tracked, point_side, 1);
    without_lower = part_without(tracked, point_side, -1);
  }
  std::vector<Match> matches(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Part* part = &whole;
    if (!side.empty() && side[i] > 0 && without_lower.tree) part = &without_lower;
    if (!side.empty() && side[i] < 0 && without_upper.tree) part = &without_upper;
    const ClosestPoint c = part->tree->query(places.row(i));
    const int f = part->triangle[c.triangle];
    for (int k = 0; k < 3; ++k) matches[i].point[k] = tracked.triangles(f, k);
    matches[i].weight = c.weights;
    matches[i].distance_m = std::sqrt(c.squared_distance);
  }
  return matches;
}

}  // namespace hyperex::reenact
