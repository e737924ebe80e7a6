// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/camera.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace hyperex::render {

Eigen::Matrix3d Camera::axes() const {
  const Vec3 toward = to_viewer.normalized();
  const Vec3 right = up.cross(toward).normalized();
  Eigen::Matrix3d camera_from_world;
  camera_from_world << right.transpose(), toward.cross(right).transpose(), toward.transpose();
  return camera_from_world;
}

Projected project(const Camera& camera, int width_px, int height_px, const Vec3& point) {
  const Vec3 local = camera.axes() * (point - camera.target);
  const double px_per_m = height_px / camera.height_m;
  return {width_px / 2.0 + local[0] * px_per_m, height_px / 2.0 - local[1] * px_per_m, local[2]};
}

Camera framing(const Points& points, const Vec3& to_viewer, double aspect, const Vec3& up,
               double margin) {
  Camera camera{.to_viewer = to_viewer, .up = up};
  const Eigen::Matrix3d camera_from_world = camera.axes();
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (!points.row(i).allFinite()) continue;
    const Vec3 local = camera_from_world * points.row(i).transpose();
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  if (!(low[0] <= high[0])) return camera;
  camera.target = camera_from_world.transpose() * (low + high) / 2;
  const Vec3 extent = high - low;
  const double frame = std::max(extent[1], extent[0] / aspect);
  camera.height_m = std::max(frame, 1e-9) / (1 - 2 * margin);
  return camera;
}

Vec3 front_view() {
  return Vec3::UnitZ();
}

Vec3 three_quarter_view() {
  constexpr double turn = 40 * std::numbers::pi / 180, lift = 6 * std::numbers::pi / 180;
  return {std::sin(turn) * std::cos(lift), std::sin(lift), std::cos(turn) * std::cos(lift)};
}

}  // namespace hyperex::render
