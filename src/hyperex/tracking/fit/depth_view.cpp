// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/depth_view.hpp"

#include <cmath>

namespace hyperex::tracking {

std::optional<SurfacePatch> surface_patch(const cv::Mat& depth_m, const capture::Intrinsics& camera,
                                          const Eigen::Vector2d& px, double expected_m,
                                          const PatchOptions& options) {
  const int u0 = int(std::lround(px.x())), v0 = int(std::lround(px.y())), r = options.radius_px;
  if (u0 < r || v0 < r || u0 + r >= depth_m.cols || v0 + r >= depth_m.rows) return std::nullopt;
  // z = c0 + c1 (u - px) + c2 (v - py)
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  double squares = 0;
  int used = 0;
  for (int v = v0 - r; v <= v0 + r; ++v) {
    const float* row = depth_m.ptr<float>(v);
    for (int u = u0 - r; u <= u0 + r; ++u) {
      const double z = double(row[u]) - expected_m;
      if (row[u] <= 0 || std::abs(z) > options.gate_m) continue;
      const Vec3 a(1, u - px.x(), v - px.y());
      normal.noalias() += a * a.transpose();
      right += z * a;
      squares += z * z;
      ++used;
    }
  }
  const double window = (2 * r + 1) * (2 * r + 1);
  if (used < options.least_share * window || used < 6) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
  const Vec3 c = factor.solve(right);
  const double z = expected_m + c[0];
  if (!c.allFinite() || z <= 0) return std::nullopt;
  SurfacePatch patch;
  patch.point = z * ray(camera, px);
  // Tangents along u and v: d(z ray)/du = c1 ray + z (1/fx, 0, 0).
  const Vec3 along_u = c[1] * ray(camera, px) + Vec3(z / camera.fx_px, 0, 0);
  const Vec3 along_v = c[2] * ray(camera, px) + Vec3(0, z / camera.fy_px, 0);
  patch.normal = along_v.cross(along_u).normalized();  // z negative: towards the camera
  patch.share = used / window;
  patch.spread_m = std::sqrt(std::max(0.0, (squares - c.dot(right)) / used));
  return patch;
}

}  // namespace hyperex::tracking
