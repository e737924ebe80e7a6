// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

namespace hyperex::report {

/// A rotation as that of its two quaternions which is nearer to the one before, so that players may
/// interpolate between them.
inline Eigen::Quaterniond near_to(const Eigen::Quaterniond& before, const Eigen::Matrix3d& turn) {
  Eigen::Quaterniond out(turn);
  if (out.dot(before) < 0) out.coeffs() *= -1;
  return out;
}

}  // namespace hyperex::report
