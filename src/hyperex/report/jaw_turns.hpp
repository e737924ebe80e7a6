// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

namespace hyperex::report {

/// The quaternion of a rotation, with the sign that brings it nearer to the previous quaternion, so
/// that players can interpolate between the two.
inline Eigen::Quaterniond near_to(const Eigen::Quaterniond& before, const Eigen::Matrix3d& turn) {
  Eigen::Quaterniond out(turn);
  if (out.dot(before) < 0) out.coeffs() *= -1;
  return out;
}

}  // namespace hyperex::report
