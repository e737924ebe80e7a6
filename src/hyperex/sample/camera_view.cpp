// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/camera_view.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "hyperex/tracking/fit/depth_view.hpp"

namespace hyperex::sample {
namespace {

constexpr render::Colour kWall = {0.45, 0.47, 0.5};  // behind the head

void check_centred(const capture::Intrinsics& camera) {
  constexpr double tolerance_px = 1e-6;
  const auto near = [](double a, double b) { return std::abs(a - b) < tolerance_px; };
  if (!near(camera.fx_px, camera.fy_px) || !near(camera.cx_px, (camera.width_px - 1) / 2.0) ||
      !near(camera.cy_px, (camera.height_px - 1) / 2.0))
    throw std::invalid_argument("colour_of: expected a centred camera of square pixels");
}

}  // namespace

Points in_camera(const Eigen::Isometry3d& camera_from_head, const Points& head) {
  return (head * camera_from_head.linear().transpose()).rowwise() +
         camera_from_head.translation().transpose().eval();
}

cv::Mat colour_of(const std::vector<SeenMesh>& meshes, const capture::Intrinsics& camera,
                  double distance_m) {
  check_centred(camera);
  std::vector<TriMesh> parallel;
  parallel.reserve(meshes.size());
  std::vector<render::Surface> surfaces;
  for (const SeenMesh& seen : meshes) {
    TriMesh& mesh = parallel.emplace_back(seen.mesh);
    for (auto point : mesh.points.rowwise())
      point = distance_m / point.z() *
              Eigen::RowVector3d(point.x(), -point.y(), distance_m - point.z());
    surfaces.push_back({.mesh = mesh, .colours = seen.colours});
  }
  render::Image image =
      render::render(surfaces, {.height_m = camera.height_px * distance_m / camera.fy_px},
                     {.width_px = camera.width_px,
                      .height_px = camera.height_px,
                      .samples = 2,
                      .background = kWall});
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(camera.height_px, camera.width_px, CV_8UC3, image.rgb.data()), bgr,
               cv::COLOR_RGB2BGR);
  return bgr;
}

cv::Mat depth_of(const TriMesh& camera_mesh, const capture::Intrinsics& camera) {
  cv::Mat depth = cv::Mat::zeros(camera.height_px, camera.width_px, CV_32F);
  for (const auto t : camera_mesh.triangles.rowwise()) {
    Eigen::Matrix3d corners, px;  // px: columns u, v, 1
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = camera_mesh.points.row(t[k]).transpose();
      px.col(k) << tracking::project(camera, corners.col(k)), 1;
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
        // 1 / z is linear in the picture's coordinates.
        const auto z = float(1 / w.dot(corners.row(2).transpose().cwiseInverse()));
        float& known = depth.at<float>(v, u);
        if (known == 0 || z < known) known = z;
      }
  }
  return depth;
}

void take_nearer(cv::Mat& depth_m, const cv::Mat& other_m) {
  for (int y = 0; y < depth_m.rows; ++y)
    for (int x = 0; x < depth_m.cols; ++x) {
      float& known = depth_m.at<float>(y, x);
      const float other = other_m.at<float>(y, x);
      if (other > 0 && (known == 0 || other < known)) known = other;
    }
}

}  // namespace hyperex::sample
