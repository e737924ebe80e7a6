// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/eyeballs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hyperex/face/ibug.hpp"
#include "hyperex/face/same_place.hpp"

namespace hyperex::anatomy {
namespace {

using Eigen::Index;

Eyeball eyeball_between(const Vec3& outer, const Vec3& inner, const Vec3& forward,
                        const Points& skin) {
  constexpr double radius_per_width = 0.4, clearance_m = 4e-4, farthest_back_m = 8e-3;
  const Vec3 middle = (outer + inner) / 2;
  const double width_m = (outer - inner).norm();
  Eyeball eye{Vec3::Zero(), forward, radius_per_width * width_m};
  // The ball's front bulges before the line of the corners by a sixth of the width.
  const Vec3 start = middle - (eye.radius_m - width_m / 6) * forward;
  double back_m = 0;
  for (Index v = 0; v < skin.rows(); ++v) {
    const Vec3 off = skin.row(v).transpose() - start;
    const double along = off.dot(forward), across = (off - along * forward).norm();
    const double reach = eye.radius_m + clearance_m;
    // Only what lies before the ball: the wall of an eye's socket may be as near as it will.
    if (across >= reach || along < 0.35 * eye.radius_m) continue;
    back_m = std::max(back_m, std::sqrt(reach * reach - across * across) - along);
  }
  eye.centre = start - std::min(back_m, farthest_back_m) * forward;
  return eye;
}

}  // namespace

/// Axes as the page has them (web/src/replay/face/face_frame.ts): a head held upright has its mouth
/// corners before its outer eye corners, by some 12 degrees.
std::optional<FaceCorners> face_corners(const io::Landmarks& landmarks) {
  const auto outer_r = face::find_place(landmarks, face::ibug(36));
  const auto outer_l = face::find_place(landmarks, face::ibug(45));
  const auto inner_r = face::find_place(landmarks, face::ibug(39));
  const auto inner_l = face::find_place(landmarks, face::ibug(42));
  const auto mouth_r = face::find_place(landmarks, face::ibug(48));
  const auto mouth_l = face::find_place(landmarks, face::ibug(54));
  if (!outer_r || !outer_l || !mouth_r || !mouth_l) return std::nullopt;
  const Vec3 x = (*outer_l - *outer_r).normalized();
  const Eigen::AngleAxisd lean(12 * std::numbers::pi / 180, x);
  const Vec3 up = lean * (*outer_l + *outer_r - *mouth_l - *mouth_r);
  return FaceCorners{
      {*outer_r, *outer_l}, {inner_r, inner_l}, {*mouth_r, *mouth_l}, x.cross(up).normalized()};
}

std::vector<Eyeball> eyeballs_behind(const Points& skin, const FaceCorners& corners) {
  std::vector<Eyeball> eyeballs;
  if (corners.inner[0] && corners.inner[1])
    for (std::size_t side = 0; side < 2; ++side)
      eyeballs.push_back(
          eyeball_between(corners.outer[side], *corners.inner[side], corners.forward, skin));
  return eyeballs;
}

}  // namespace hyperex::anatomy
