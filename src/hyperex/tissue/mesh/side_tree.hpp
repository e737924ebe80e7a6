// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// A place on a triangle mesh by its vertices.
struct PlaceOnMesh {
  std::array<int, 3> vertex{};
  Vec3 weight = Vec3::Zero();  ///< barycentric, each >= 0, sum 1
  double distance_m = 0;       ///< from the query point

  /// Interpolates `of_vertices`. Reproduces a constant exactly.
  double value(const Eigen::VectorXd& of_vertices) const {
    const double first = of_vertices[vertex[0]];
    return first + weight[1] * (of_vertices[vertex[1]] - first) +
           weight[2] * (of_vertices[vertex[2]] - first);
  }
};

/// Closest points on a face. Near the mouth, they lie on the same lip as the query point, although
/// the other lip may be nearer in a straight line. `margin` as in upper_lip_margin: above 0 on the
/// upper side, 0 on neither.
class SideTree {
 public:
  /// Sides are distinguished only within the sphere about the mouth.
  SideTree(const TriMesh& mesh, const std::vector<double>& margin, const Vec3& mouth,
           double reach_m);
  /// `margin` of the query point: where |margin| < 4 mm, both sides are searched.
  PlaceOnMesh query(const Vec3& point, double margin) const;

 private:
  double margin_of(int triangle) const;
  Triangles triangles_;
  std::vector<double> margin_;
  Vec3 mouth_;
  double reach_m_;
  SurfaceTree whole_;
  std::array<std::vector<int>, 2> part_;  // triangles that are not of the upper, lower side
  std::array<std::optional<SurfaceTree>, 2> side_;
};

}  // namespace hyperex::tissue
