// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/side_tree.hpp"

#include <cmath>

namespace hyperex::tissue {
namespace {
// Beside the mouth's corners the paths to both lips are equally long.
constexpr double kSure_m = 0.004;
}  // namespace

SideTree::SideTree(const TriMesh& mesh, const std::vector<double>& margin, const Vec3& mouth,
                   double reach_m)
    : triangles_(mesh.triangles), margin_(margin), mouth_(mouth), reach_m_(reach_m), whole_(mesh) {
  for (int f = 0; f < triangles_.rows(); ++f) {
    if (margin_of(f) <= 0) part_[0].push_back(f);
    if (margin_of(f) >= 0) part_[1].push_back(f);
  }
  for (int side = 0; side < 2; ++side) {
    const auto count = static_cast<Eigen::Index>(part_[side].size());
    if (count == 0 || count == triangles_.rows()) continue;
    TriMesh part{mesh.points, Triangles(count, 3)};
    for (Eigen::Index i = 0; i < count; ++i) part.triangles.row(i) = triangles_.row(part_[side][i]);
    side_[side].emplace(part);
  }
}

double SideTree::margin_of(int triangle) const {
  return (margin_[triangles_(triangle, 0)] + margin_[triangles_(triangle, 1)] +
          margin_[triangles_(triangle, 2)]) /
         3;
}

PlaceOnMesh SideTree::query(const Vec3& point, double margin) const {
  ClosestPoint closest = whole_.query(point);
  if (std::abs(margin) >= kSure_m && margin_of(closest.triangle) * margin < 0 &&
      (point - mouth_).norm() < reach_m_) {
    const int side = margin > 0;
    if (side_[side]) {
      closest = side_[side]->query(point);
      closest.triangle = part_[side][closest.triangle];
    }
  }
  PlaceOnMesh place;
  for (int k = 0; k < 3; ++k) place.vertex[k] = triangles_(closest.triangle, k);
  place.weight = closest.weights;
  place.distance_m = std::sqrt(closest.squared_distance);
  return place;
}

}  // namespace hyperex::tissue
