// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

#include "hyperex/geometry/types.hpp"

namespace hyperex::anatomy {

struct SurfaceAlignment {
  Eigen::Isometry3d to_from_points = Eigen::Isometry3d::Identity();
  /// Distances of the moved points from the surface, m. Points that were left out count.
  double median_m = 0, p95_m = 0;
};

/// The rigid motion that lays points on a surface, by iterated closest points from `start`. In each
/// round the nearest `kept_share` of the points count, by their distance along the surface's normal
/// (Chen and Medioni, Image and Vision Computing 10, 1992; trimmed as by Chetverikov et al., 2005).
/// Points that hang over the border of the surface are left out. `points`: six or more.
SurfaceAlignment align_to_surface(const Points& points, const TriMesh& surface,
                                  const Eigen::Isometry3d& start, double kept_share = 0.8);

}  // namespace hyperex::anatomy
