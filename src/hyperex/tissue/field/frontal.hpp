// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// Linear interpolation over the Delaunay triangles of points in a plane, here of a face seen from
/// the front. Outside the convex hull, the value is that at the nearest place of the hull. The
/// field is continuous, with kinks along the triangles' edges. Four points on a circle, such as two
/// symmetric pairs, have two triangulations. Therefore the mean of the interpolations in the plane
/// and in its mirror image (x -> -x) is taken, so that mirrored points give the mirrored field. If
/// all points lie on a line, the field is linear along it.
class FrontalField {
 public:
  /// `points`: n x 2, n >= 1, no two closer than 0.1 mm.
  explicit FrontalField(const Eigen::MatrixX2d& points);
  ~FrontalField();
  /// One value per point -> one per row of `places` (m x 2).
  Eigen::VectorXd at(const Eigen::MatrixX2d& places, const Eigen::VectorXd& values) const;

 private:
  struct Plane;
  std::vector<std::unique_ptr<Plane>> planes_;  // as given, mirrored
};

}  // namespace hyperex::tissue
