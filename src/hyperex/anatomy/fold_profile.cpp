// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/fold_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/face/ibug.hpp"

namespace hyperex::anatomy {
namespace {

constexpr double kStep_mm = 0.25, kNoseSide_mm = 6, kCheekSide_mm = 26;
constexpr double kLeastWidth_mm = 2, kGreatestWidth_mm = 20, kSmoothing_mm = 1;
/// Triangles farther than this from the fold are left out.
constexpr double kFoldReach_mm = 45;
/// A profile that ends nearer, at a hole or at the border, is not measured.
constexpr double kNeeded_mm = 20;
constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

std::vector<double> smoothed_profile(const std::vector<double>& height) {
  const auto reach = std::ptrdiff_t(3 * kSmoothing_mm / kStep_mm);
  std::vector<double> out(height.size(), kNoHeight);
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

FoldProfile::FoldProfile(const TriMesh& skin, const io::Landmarks& landmarks, bool left)
    : frame_(face::face_frame(landmarks)) {
  const auto place = [&](int right, int other) -> Place {
    return 1e3 * frame_.local(landmarks.at(face::ibug(left ? other : right))).head<2>();
  };
  wing_ = place(31, 35);
  const Place corner = place(48, 54), about = (wing_ + corner) / 2;
  along_ = corner - wing_;
  across_ = Place(-along_.y(), along_.x()).normalized();
  if (across_.x() * (left ? 1 : -1) < 0) across_ = -across_;
  const Points points = 1e3 * frame_.local_points(skin.points);
  for (const auto& triangle : skin.triangles.rowwise()) {
    Seen one;
    for (int c = 0; c < 3; ++c) one.corners.row(c) = points.row(triangle[c]);
    const auto flat = one.corners.leftCols<2>();
    one.low = flat.colwise().minCoeff();
    one.high = flat.colwise().maxCoeff();
    if ((one.low - about).cwiseAbs().maxCoeff() < kFoldReach_mm) seen_.push_back(one);
  }
}

/// The height of the triangle at a place; nothing where it does not cover the place.
std::optional<double> FoldProfile::Seen::height_at(const Place& at) const {
  if ((at.array() < low.array()).any() || (at.array() > high.array()).any()) return {};
  const Place a = corners.row(0).head<2>(), b = corners.row(1).head<2>(),
              c = corners.row(2).head<2>();
  Eigen::Matrix2d edges;
  edges << b - a, c - a;
  if (std::abs(edges.determinant()) < 1e-12) return {};
  const Place w = edges.inverse() * (at - a);
  if (w.minCoeff() < -1e-9 || w.sum() > 1 + 1e-9) return {};
  const Vec3 z = corners.col(2);
  return z[0] + w[0] * (z[1] - z[0]) + w[1] * (z[2] - z[0]);
}

/// The foremost surface; NaN where there is none.
double FoldProfile::height_at(const Place& at) const {
  double out = kNoHeight;
  for (const Seen& one : seen_)
    if (const auto height = one.height_at(at)) out = std::fmax(out, *height);
  return out;
}

std::optional<Groove> FoldProfile::groove(double share) const {
  std::vector<double> height;
  for (double s = -kNoseSide_mm; s < kCheekSide_mm; s += kStep_mm)
    height.push_back(height_at(wing_ + share * along_ + s * across_));
  const auto ends = std::ranges::find_if(height, [](double h) { return std::isnan(h); });
  if (double(ends - height.begin()) * kStep_mm < kNoseSide_mm + kNeeded_mm) return {};
  Groove found = groove_of(smoothed_profile(height), kStep_mm);
  found.place_mm -= kNoseSide_mm;
  return found;
}

}  // namespace hyperex::anatomy
