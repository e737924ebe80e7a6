// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/mouth_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::metrics {
namespace {

constexpr double kNear_m = 0.010;
constexpr double kStep_m = 0.001, kSmooth_m = 0.0015;

/// Points of the closed line at equal distances of about `step_m` along it.
Points resampled(const Points& line, double step_m) {
  const Eigen::Index n = line.rows();
  std::vector<double> along(std::size_t(n) + 1, 0);
  for (Eigen::Index i = 0; i < n; ++i)
    along[std::size_t(i) + 1] =
        along[std::size_t(i)] + (line.row((i + 1) % n) - line.row(i)).norm();
  const double length = along.back();
  const auto count = std::max(Eigen::Index(4), Eigen::Index(std::lround(length / step_m)));
  Points out(count, 3);
  Eigen::Index piece = 0;
  for (Eigen::Index s = 0; s < count; ++s) {
    const double at = length * double(s) / double(count);
    while (piece + 1 < n && along[std::size_t(piece) + 1] < at) ++piece;
    const double from = along[std::size_t(piece)], to = along[std::size_t(piece) + 1];
    const double share = to > from ? (at - from) / (to - from) : 0;
    out.row(s) = (1 - share) * line.row(piece) + share * line.row((piece + 1) % n);
  }
  return out;
}

/// Smooths the closed line by a Gaussian of `sigma` samples.
Points smoothed(const Points& line, double sigma) {
  const Eigen::Index n = line.rows();
  const auto reach = std::min(n / 2, Eigen::Index(std::ceil(4 * sigma)));
  Points out = Points::Zero(n, 3);
  double sum = 0;
  for (Eigen::Index off = -reach; off <= reach; ++off) {
    const double weight = std::exp(-0.5 * std::pow(double(off) / sigma, 2));
    sum += weight;
    for (Eigen::Index s = 0; s < n; ++s) out.row(s) += weight * line.row((s + off + n) % n);
  }
  return out / sum;
}

double turning_deg(const Points& line) {
  const Eigen::Index n = line.rows();
  double sum = 0;
  for (Eigen::Index s = 0; s < n; ++s) {
    const Vec3 before = line.row((s + 1) % n) - line.row(s);
    const Vec3 after = line.row((s + 2) % n) - line.row((s + 1) % n);
    sum += std::atan2(before.cross(after).norm(), before.dot(after));
  }
  return sum * 180 / M_PI;
}

}  // namespace

std::vector<int> mouth_rim(const TriMesh& skin, const io::Landmarks& landmarks) {
  std::vector<int> nearest;
  double least_m = kNear_m;
  for (auto& loop : boundary_loops(skin.triangles)) {
    double sum_m = 0;
    for (int k = 60; k <= 67; ++k) {
      double from_point_m = std::numeric_limits<double>::infinity();
      for (const int v : loop)
        from_point_m = std::min(
            from_point_m, (skin.points.row(v).transpose() - landmarks.at(face::ibug(k))).norm());
      sum_m += from_point_m;
    }
    if (sum_m / 8 >= least_m) continue;
    least_m = sum_m / 8;
    nearest = loop;
  }
  return nearest;
}

std::optional<MouthOutline> mouth_outline(const TriMesh& skin, const std::vector<int>& rim,
                                          const PointsF& displacement) {
  if (rim.size() < 4) return std::nullopt;
  const Points moved = displacement(rim, Eigen::all).cast<double>();
  MouthOutline outline;
  for (Eigen::Index i = 0; i < moved.rows(); ++i)
    outline.largest_jump_mm = std::max(
        outline.largest_jump_mm, 1e3 * (moved.row((i + 1) % moved.rows()) - moved.row(i)).norm());
  const Points line = resampled(skin.points(rim, Eigen::all) + moved, kStep_m);
  outline.turning_deg = turning_deg(smoothed(line, kSmooth_m / kStep_m));
  return outline;
}

}  // namespace hyperex::metrics
