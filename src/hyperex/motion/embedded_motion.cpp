// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/embedded_motion.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::motion {

namespace {

constexpr double kCondyleInwards = 0.1;  // of the width between the outlines beside the ears
constexpr double kNod_deg = 2.5, kTurn_deg = 3.5, kShift_m = 0.004;

/// How far a point follows the jaw, 0 to 1.
double jaw_share(const std::string& name) {
  static const std::map<std::string, double> shares = [] {
    std::map<std::string, double> made = {{"cheilion_L", 0.4},
                                          {"cheilion_R", 0.4},
                                          {"stomion", 0.0},
                                          {"labiale_inferius", 1.0},
                                          {"pogonion", 1.0}};
    const auto set = [&](std::initializer_list<int> points, double share) {
      for (const int k : points) made[face::ibug(k)] = share;
    };
    set({6, 7, 8, 9, 10, 56, 57, 58, 65, 66, 67}, 1.0);
    set({5, 11}, 0.9);
    set({4, 12}, 0.7);
    set({3, 13}, 0.4);
    set({2, 14}, 0.15);
    set({55, 59}, 0.8);
    set({48, 54, 60, 64}, 0.4);
    return made;
  }();
  const auto found = shares.find(name);
  return found == shares.end() ? 0 : found->second;
}

Vec3 needed(const io::Landmarks& landmarks, const std::string& name) {
  const auto found = landmarks.find(name);
  if (found == landmarks.end())
    throw InputError("embedded motion",
                     "landmark " + name + " is missing: the jaw's axis needs it");
  return found->second;
}

Eigen::Isometry3d turn_about(const Vec3& centre, const Vec3& axis, double angle) {
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.translate(centre).rotate(Eigen::AngleAxisd(angle, axis)).translate(-centre);
  return turn;
}

}  // namespace

Motion embedded_mouth_opening(const io::Landmarks& landmarks, const MouthOpeningOptions& options) {
  const int samples = int(std::lround(options.duration_s * options.rate_hz));
  if (!(options.peak_deg > 0) || !(options.rate_hz > 0) || samples < 3)
    throw InputError("embedded motion", "expected a positive angle and rate and three samples");
  const Vec3 right = needed(landmarks, face::ibug(1)), left = needed(landmarks, face::ibug(15));
  const Vec3 chin = needed(landmarks, face::ibug(8)), nasion = needed(landmarks, face::ibug(27));
  const Vec3 condyle_right = right + kCondyleInwards * (left - right);
  const Vec3 axis =
      (left - right).normalized();  // to the subject's left: a turn about it lowers the chin
  const Vec3 up_ = nasion - chin, up = (up_ - up_.dot(axis) * axis).normalized();
  const double degree = std::numbers::pi / 180, last_s = (samples - 1) / options.rate_hz;

  Motion motion;
  motion.source = "embedded mouth opening";
  motion.unit_note = "m (made, not measured)";
  for (const auto& [name, position] : landmarks) motion.names.push_back(name);
  for (int k = 0; k < samples; ++k) {
    const double t = k / options.rate_hz, phase = 2 * std::numbers::pi * t / last_s;
    const double jaw = options.peak_deg * degree * (1 - std::cos(phase)) / 2;
    Eigen::Isometry3d head = Eigen::Isometry3d::Identity();
    if (options.head_moves) {
      const double sway = std::sin(phase) * (1 - std::cos(phase)) / 2,
                   nod = (1 - std::cos(phase)) / 2;
      head = turn_about(condyle_right, up, kTurn_deg * degree * sway) *
             turn_about(condyle_right, axis, -kNod_deg * degree * nod);
      head.pretranslate(kShift_m * (nod * up + sway * axis));
    }
    Points sample(Eigen::Index(motion.names.size()), 3);
    Eigen::Index row = 0;
    for (const auto& [name, position] : landmarks) {
      const double angle = jaw * jaw_share(name);
      sample.row(row++) = head * (turn_about(condyle_right, axis, angle) * position);
    }
    motion.time_s.push_back(t);
    motion.positions.push_back(std::move(sample));
  }
  return motion;
}

}  // namespace hyperex::motion
