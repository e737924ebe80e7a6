// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The data that a depth camera and the landmark network would give for a face with known vertices.
#include "hyperex/sample/camera_view.hpp"
#include "hyperex/tracking/fit/frame_fit.hpp"

namespace hyperex::tracking {

using sample::depth_of;
using sample::in_camera;

/// The network's 468 points, at the vertices of a canonical face.
inline Points network_of(const Points& camera_points, const capture::Intrinsics& camera) {
  Points network(camera_points.rows(), 3);
  for (Eigen::Index v = 0; v < camera_points.rows(); ++v) {
    const Vec3 p = camera_points.row(v).transpose();
    network.row(v) << project(camera, p).transpose(), p.z() * camera.fx_px / 0.6;
  }
  return network;
}

}  // namespace hyperex::tracking
