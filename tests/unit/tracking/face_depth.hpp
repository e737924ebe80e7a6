// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a depth camera and the landmark network would see of a face whose vertices are known.
#include <algorithm>
#include <cmath>

#include "hyperex/tracking/fit/frame_fit.hpp"

namespace hyperex::tracking {

inline Points in_camera(const Eigen::Isometry3d& camera_from_head, const Points& head) {
  return (head * camera_from_head.linear().transpose()).rowwise() +
         camera_from_head.translation().transpose().eval();
}

/// The depth picture of a mesh (camera frame, metres), 0 where it is not; the nearest surface wins.
inline cv::Mat depth_of(const TriMesh& camera_mesh, const capture::Intrinsics& camera) {
  cv::Mat depth = cv::Mat::zeros(camera.height_px, camera.width_px, CV_32F);
  for (const auto t : camera_mesh.triangles.rowwise()) {
    Eigen::Matrix3d corners, px;  // px: columns u, v, 1
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = camera_mesh.points.row(t[k]).transpose();
      px.col(k) << project(camera, corners.col(k)), 1;
    }
    if (std::abs(px.determinant()) < 1e-9) continue;
    const Eigen::Matrix3d weights_of = px.inverse();
    const Eigen::Vector3d low = px.rowwise().minCoeff(), high = px.rowwise().maxCoeff();
    for (int v = std::max(0, int(std::ceil(low.y())));
         v <= std::min(camera.height_px - 1, int(high.y())); ++v)
      for (int u = std::max(0, int(std::ceil(low.x())));
           u <= std::min(camera.width_px - 1, int(high.x())); ++u) {
        const Vec3 w = weights_of * Vec3(u, v, 1);
        if (w.minCoeff() < 0) continue;
        // Linear in the picture is 1 / z.
        const auto z = float(1 / w.dot(corners.row(2).transpose().cwiseInverse()));
        float& known = depth.at<float>(v, u);
        if (known == 0 || z < known) known = z;
      }
  }
  return depth;
}

/// The network's 468 points where the vertices of a canonical face are.
inline Points network_of(const Points& camera_points, const capture::Intrinsics& camera) {
  Points network(camera_points.rows(), 3);
  for (Eigen::Index v = 0; v < camera_points.rows(); ++v) {
    const Vec3 p = camera_points.row(v).transpose();
    network.row(v) << project(camera, p).transpose(), p.z() * camera.fx_px / 0.6;
  }
  return network;
}

}  // namespace hyperex::tracking
