// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <optional>

#include "hyperex/capture/frame.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tracking {

/// Pinhole projection and its inverse; camera frame x right, y down, z forward.
inline Eigen::Vector2d project(const capture::Intrinsics& k, const Vec3& p) {
  return {k.fx_px * p.x() / p.z() + k.cx_px, k.fy_px * p.y() / p.z() + k.cy_px};
}
inline Vec3 ray(const capture::Intrinsics& k, const Eigen::Vector2d& px) {
  return {(px.x() - k.cx_px) / k.fx_px, (px.y() - k.cy_px) / k.fy_px, 1};
}
/// Jacobian of project() with respect to p.
inline Eigen::Matrix<double, 2, 3> project_jacobian(const capture::Intrinsics& k, const Vec3& p) {
  const double i = 1 / p.z();
  Eigen::Matrix<double, 2, 3> j;
  j << k.fx_px * i, 0, -k.fx_px * p.x() * i * i, 0, k.fy_px * i, -k.fy_px * p.y() * i * i;
  return j;
}

/// A plane fitted locally to the depth picture.
struct SurfacePatch {
  Vec3 point;           ///< camera frame, metres
  Vec3 normal;          ///< unit, towards the camera
  double share = 0;     ///< share of the window's pixels with a reading on this surface, 0 to 1
  double spread_m = 0;  ///< root mean square distance of the readings from the plane
};

struct PatchOptions {
  int radius_px = 3;
  double gate_m = 0.012;     ///< readings farther than this from the expected depth are ignored
  double least_share = 0.4;  ///< of the window
};

/// The plane that fits the depth readings in a square window around `px` by least squares in z.
/// Only readings near `expected_m` are used. Returns nothing if there are too few of them or if the
/// window extends beyond the picture.
std::optional<SurfacePatch> surface_patch(const cv::Mat& depth_m, const capture::Intrinsics& camera,
                                          const Eigen::Vector2d& px, double expected_m,
                                          const PatchOptions& options = {});

}  // namespace hyperex::tracking
