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

constexpr double kRadiusPerWidth = 0.4, kClearance_m = 4e-4;
constexpr double kFarthestBack_m = 8e-3, kFarthestForward_m = 2.5e-3;

/// An eye before its ball has its place.
struct Eye {
  Eyeball ball;  ///< with the front before the line of the corners by a sixth of their distance
  Vec3 to_nose;  ///< unit length
  Points lids;   ///< the skin about it
};

Eye eye_between(const Vec3& outer, const Vec3& inner, const Vec3& to_nose, const Vec3& forward,
                const Points& skin) {
  const double width_m = (outer - inner).norm(), radius_m = kRadiusPerWidth * width_m;
  const Vec3 centre = (outer + inner) / 2 - (radius_m - width_m / 6) * forward;
  std::vector<Index> near;
  for (Index v = 0; v < skin.rows(); ++v)
    if ((skin.row(v).transpose() - centre).norm() < 2 * radius_m) near.push_back(v);
  return {{centre, forward, radius_m}, to_nose, skin(near, Eigen::all)};
}

/// How far forward the lids let the ball come if its centre is shifted first; 0 without lids.
double forward_m(const Eye& eye, const Vec3& shift) {
  const Vec3& forward = eye.ball.gaze;
  const double reach = eye.ball.radius_m + kClearance_m;
  double room_m = INFINITY;
  for (Index v = 0; v < eye.lids.rows(); ++v) {
    const Vec3 off = eye.lids.row(v).transpose() - eye.ball.centre - shift;
    const double along = off.dot(forward), across = (off - along * forward).norm();
    // Only what lies before the ball: the wall of an eye's socket may be as near as it will.
    if (across >= reach || along < 0.35 * eye.ball.radius_m) continue;
    room_m = std::min(room_m, along - std::sqrt(reach * reach - across * across));
  }
  if (!std::isfinite(room_m)) return 0;
  return std::clamp(room_m, -kFarthestBack_m, kFarthestForward_m);
}

/// A shift towards the nose and up that both eyes share, so that they stay alike.
struct Shift {
  double to_nose_m = 0, up_m = 0;

  Vec3 of(const Eye& eye, const Vec3& up) const { return to_nose_m * eye.to_nose + up_m * up; }
};

/// The shift that brings the balls farthest forward, less its price.
Shift best_shift(const std::vector<Eye>& eyes, const Vec3& up) {
  constexpr int steps = 6;
  constexpr double step_m = 2.5e-4, price_to_nose = 0.3, price_up = 0.4, least_gain_m = 1e-9;
  Shift best;
  double most_m = -INFINITY;
  for (int aside = 0; aside <= steps; ++aside)
    for (int above = 0; above <= steps; ++above) {
      const Shift shift{aside * step_m, above * step_m};
      double gain_m = -price_to_nose * shift.to_nose_m - price_up * shift.up_m;
      for (const Eye& eye : eyes) gain_m += forward_m(eye, shift.of(eye, up)) / double(eyes.size());
      if (gain_m <= most_m + least_gain_m) continue;
      most_m = gain_m;
      best = shift;
    }
  return best;
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
  if (!corners.inner[0] || !corners.inner[1]) return {};
  const Vec3 left = (corners.outer[1] - corners.outer[0]).normalized();
  const Vec3 up = corners.forward.cross(left).normalized();
  std::vector<Eye> eyes;
  for (std::size_t side = 0; side < 2; ++side)
    eyes.push_back(eye_between(corners.outer[side], *corners.inner[side], side == 0 ? left : -left,
                               corners.forward, skin));
  const Shift shift = best_shift(eyes, up);
  std::vector<Eyeball> eyeballs;
  for (const Eye& eye : eyes) {
    const Vec3 aside = shift.of(eye, up);
    eyeballs.push_back(eye.ball);
    eyeballs.back().centre += aside + forward_m(eye, aside) * corners.forward;
  }
  return eyeballs;
}

}  // namespace hyperex::anatomy
