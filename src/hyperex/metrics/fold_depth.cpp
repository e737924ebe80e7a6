// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/fold_depth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/nan.hpp"

namespace hyperex::metrics {
namespace {

constexpr double kStep_mm = 0.25, kNoseSide_mm = 6, kCheekSide_mm = 26;
constexpr double kLeastWidth_mm = 2, kGreatestWidth_mm = 20, kSmoothing_mm = 1;
constexpr std::array kShares = {0.3, 0.5, 0.7};
/// A shallower groove has no place. Triangles farther than kReach_mm from the fold are left out.
constexpr double kLeastDepth_mm = 0.5, kReach_mm = 45;
/// A profile that ends nearer, at a hole or at the border, is not measured.
constexpr double kNeeded_mm = 20;

/// A triangle seen from the front, mm.
struct Seen {
  Eigen::Matrix<double, 3, 3> corners;  ///< rows: x, y, z
  Eigen::Vector2d low, high;
};

std::vector<Seen> seen_from_front(const TriMesh& skin, const face::FaceFrame& frame,
                                  const Eigen::Vector2d& about_mm) {
  const Points points = 1e3 * frame.local_points(skin.points);
  std::vector<Seen> out;
  for (const auto& triangle : skin.triangles.rowwise()) {
    Seen one;
    for (int c = 0; c < 3; ++c) one.corners.row(c) = points.row(triangle[c]);
    const auto flat = one.corners.leftCols<2>();
    one.low = flat.colwise().minCoeff();
    one.high = flat.colwise().maxCoeff();
    if ((one.low - about_mm).cwiseAbs().maxCoeff() < kReach_mm) out.push_back(one);
  }
  return out;
}

/// The height of a triangle at a place; nothing where the triangle does not cover the place.
std::optional<double> height_at(const Seen& seen, const Eigen::Vector2d& at) {
  if ((at.array() < seen.low.array()).any() || (at.array() > seen.high.array()).any()) return {};
  const Eigen::Vector2d a = seen.corners.row(0).head<2>(), b = seen.corners.row(1).head<2>(),
                        c = seen.corners.row(2).head<2>();
  Eigen::Matrix2d edges;
  edges << b - a, c - a;
  if (std::abs(edges.determinant()) < 1e-12) return {};
  const Eigen::Vector2d w = edges.inverse() * (at - a);
  if (w.minCoeff() < -1e-9 || w.sum() > 1 + 1e-9) return {};
  const Vec3 z = seen.corners.col(2);
  return z[0] + w[0] * (z[1] - z[0]) + w[1] * (z[2] - z[0]);
}

/// The foremost surface; NaN where there is none.
double height_at(const std::vector<Seen>& skin, const Eigen::Vector2d& at) {
  double out = kNan;
  for (const Seen& one : skin)
    if (const auto height = height_at(one, at)) out = std::fmax(out, *height);
  return out;
}

std::vector<double> smoothed(const std::vector<double>& height) {
  const auto reach = std::ptrdiff_t(3 * kSmoothing_mm / kStep_mm);
  std::vector<double> out(height.size(), kNan);
  for (std::ptrdiff_t i = 0; i < std::ptrdiff_t(height.size()); ++i) {
    if (std::isnan(height[std::size_t(i)])) continue;
    double sum = 0, weights = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const std::ptrdiff_t j = i + k;
      if (j < 0 || j >= std::ptrdiff_t(height.size()) || std::isnan(height[std::size_t(j)]))
        continue;
      const double weight = std::exp(-0.5 * std::pow(double(k) * kStep_mm / kSmoothing_mm, 2));
      sum += weight * height[std::size_t(j)];
      weights += weight;
    }
    out[std::size_t(i)] = sum / weights;
  }
  return out;
}

}  // namespace

Groove groove_of(const std::vector<double>& height_mm, double step_mm) {
  const auto ends = std::find_if(height_mm.begin(), height_mm.end(),
                                 [](double height) { return std::isnan(height); });
  const auto count = std::size_t(ends - height_mm.begin());
  const auto least = std::size_t(std::lround(kLeastWidth_mm / step_mm)),
             most = std::size_t(std::lround(kGreatestWidth_mm / step_mm));
  Groove best;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + least; b < std::min(count, a + most + 1); ++b) {
      const double slope = (height_mm[b] - height_mm[a]) / double(b - a);
      const double level = std::hypot(1, slope / step_mm);
      for (std::size_t i = a + 1; i < b; ++i) {
        const double depth = (height_mm[a] + slope * double(i - a) - height_mm[i]) / level;
        if (depth > best.depth_mm) best = {depth, step_mm * double(i)};
      }
    }
  return best;
}

std::array<FoldCut, 3> fold_cuts(const TriMesh& skin, const io::Landmarks& landmarks, bool left) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const auto place = [&](int right, int other) -> Eigen::Vector2d {
    return 1e3 * frame.local(landmarks.at(face::ibug(left ? other : right))).head<2>();
  };
  const Eigen::Vector2d wing = place(31, 35), corner = place(48, 54), along = corner - wing;
  const std::vector<Seen> seen = seen_from_front(skin, frame, (wing + corner) / 2);
  Eigen::Vector2d across = Eigen::Vector2d(-along.y(), along.x()).normalized();
  if (across.x() * (left ? 1 : -1) < 0) across = -across;
  std::array<FoldCut, 3> out;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    std::vector<double> height;
    for (double s = -kNoseSide_mm; s < kCheekSide_mm; s += kStep_mm)
      height.push_back(height_at(seen, wing + kShares[i] * along + s * across));
    const auto ends = std::ranges::find_if(height, [](double h) { return std::isnan(h); });
    if (double(ends - height.begin()) * kStep_mm < kNoseSide_mm + kNeeded_mm) {
      out[i] = {kNan, kNan};
      continue;
    }
    const Groove groove = groove_of(smoothed(height), kStep_mm);
    out[i] = {groove.depth_mm,
              groove.depth_mm >= kLeastDepth_mm ? groove.place_mm - kNoseSide_mm : kNan};
  }
  return out;
}

}  // namespace hyperex::metrics
