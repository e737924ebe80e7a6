// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// Linear interpolation over the Delaunay triangles of points in a plane, here of a face seen from
/// in front; outside their hull the value at the hull's nearest place. Continuous, with kinks along
/// the triangles' edges. Four points on a circle (two pairs alike on both sides are) have two
/// triangulations: the mean of the plane's and of its mirror image's (x -> -x) is taken, so that
/// mirrored points give the mirrored field. With all points on a line: linear along it.
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
