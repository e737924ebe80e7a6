// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The pictures that a colour and depth camera takes of meshes.
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "hyperex/capture/intrinsics.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::sample {

/// A mesh in the camera's frame (x right, y down, z forward, metres) and its colours, one row per
/// vertex.
struct SeenMesh {
  const TriMesh& mesh;
  const render::VertexColours& colours;
};

/// Transforms points from the head's frame to the camera's.
Points in_camera(const Eigen::Isometry3d& camera_from_head, const Points& head);

/// The colour picture, CV_8UC3, BGR, lit by the lamps of render(). `distance_m`: distance of the
/// face, > 0. The renderer uses parallel rays; the projective map
///   (x, y, z) -> d (x, -y, d - z) / z,  d = distance_m,
/// makes the camera's rays parallel and keeps triangles plane. At z = d it keeps lengths. The
/// principal point must be the picture's centre and fx = fy (std::invalid_argument otherwise).
cv::Mat colour_of(const std::vector<SeenMesh>& meshes, const capture::Intrinsics& camera,
                  double distance_m);

/// The depth picture, CV_32F, metres, 0 where there is no surface. Where several surfaces lie on a
/// ray, the nearest counts.
cv::Mat depth_of(const TriMesh& camera_mesh, const capture::Intrinsics& camera);
/// Sets each reading to the nearer of both. The pictures have the same size.
void take_nearer(cv::Mat& depth_m, const cv::Mat& other_m);

}  // namespace hyperex::sample
