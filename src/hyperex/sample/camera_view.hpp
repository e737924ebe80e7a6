// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a camera of colour and depth sees of meshes.
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "hyperex/capture/intrinsics.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::sample {

/// A mesh in the camera's frame (x right, y down, z forward, metres) and its colours, a row per
/// vertex.
struct SeenMesh {
  const TriMesh& mesh;
  const render::VertexColours& colours;
};

/// Points of the head's frame in the camera's.
Points in_camera(const Eigen::Isometry3d& camera_from_head, const Points& head);

/// The colour picture, CV_8UC3, BGR, lit by the lamps of render(). `distance_m`: of the face, > 0.
/// The renderer looks along parallel rays; the projective map
///   (x, y, z) -> d (x, -y, d - z) / z,  d = distance_m,
/// makes the camera's rays parallel, keeps triangles plane and, at z = d, lengths. The principal
/// point must be the picture's centre and fx = fy (std::invalid_argument otherwise).
cv::Mat colour_of(const std::vector<SeenMesh>& meshes, const capture::Intrinsics& camera,
                  double distance_m);

/// The depth picture, CV_32F, metres, 0 where no surface is; the nearest surface wins.
cv::Mat depth_of(const TriMesh& camera_mesh, const capture::Intrinsics& camera);
/// The nearer reading of both; of one size.
void take_nearer(cv::Mat& depth_m, const cv::Mat& other_m);

}  // namespace hyperex::sample
