// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// b = scale * rotation * a + translation.
struct Similarity {
  double scale = 1;  ///< > 0
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 operator*(const Vec3& a) const { return scale * (rotation * a) + translation; }
  /// One point per row.
  Points apply(const Points& a) const;
  Similarity inverse() const;
};

/// The rigid (scale = 1) or similarity transform b_from_a that minimises
///   sum_i w_i |b_i - (s R a_i + t)|^2,  det R = +1.
/// Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
/// IEEE PAMI 13 (1991); Kabsch for the rigid case. `a`, `b`: n x 3, n >= 3, finite. `weights`: n
/// values >= 0 with a positive sum; empty: all equal. If the points lie on one line, the rotation
/// about it is undetermined: check spread_off_line() first. Throws std::invalid_argument if sizes
/// or weights are invalid.
Eigen::Isometry3d fit_rigid(const Points& a, const Points& b, const Eigen::VectorXd& weights = {});
Similarity fit_similarity(const Points& a, const Points& b, const Eigen::VectorXd& weights = {});

/// Weighted root mean square distance, length unit of the points.
double rms_distance(const Points& a, const Points& b, const Eigen::VectorXd& weights = {});

/// Measures how far the points are from being collinear, from 0 (collinear) to 1: the ratio of the
/// second to the first singular value of the centred points. 0 for fewer than three points.
double spread_off_line(const Points& points);

}  // namespace hyperex
