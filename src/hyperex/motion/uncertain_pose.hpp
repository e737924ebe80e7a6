// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

#include "hyperex/geometry/types.hpp"

namespace hyperex::motion {

/// The pose of the head in one sample, and its uncertainty.
struct UncertainPose {
  /// Maps the position of a point of the head in sample 0 to its position in this sample.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Covariance of the error: a rotation (rad) about `centre` and a translation (m), in the axes of
  /// sample 0.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// The part of the covariance that white jitter of the points makes; 0 where it is not known.
  Eigen::Matrix<double, 6, 6> of_jitter = Eigen::Matrix<double, 6, 6>::Zero();
  Vec3 centre = Vec3::Zero();  ///< in sample 0

  /// The covariance where the tracks without head pose are filtered, so that of the variance of
  /// white jitter the share `left` (0 to 1) is left.
  Eigen::Matrix<double, 6, 6> filtered(double left) const {
    return covariance - (1 - left) * of_jitter;
  }
};

/// Derivative of the position of a point at `arm` from the centre, with respect to a small rotation
/// and translation.
Eigen::Matrix<double, 3, 6> pose_derivative(const Vec3& arm);

}  // namespace hyperex::motion
