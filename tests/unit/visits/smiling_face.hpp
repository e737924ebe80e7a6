// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Recordings of a smile whose truth is known.
#include <cmath>
#include <random>
#include <string>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::visits {

struct Smile {
  double right = 1, left = 1;  ///< share of the whole smile on that side
  double noise_m = 0;
  bool head_moves = false;
  unsigned seed = 0;
  double dragged_right = 0;  ///< movement of the right corner towards the left, m
};

/// Movement of the corner of the mouth in a whole smile: outward, upward, forward, m.
inline const Vec3 kWholeSmile(0.006, 0.009, -0.004);

/// The movement of a point at `place` of the canonical face in a whole smile. It falls off with the
/// distance from the corner of the mouth.
inline Vec3 smile_at(const Vec3& place, const Smile& smile) {
  constexpr double reach_m = 0.02;
  const face::CanonicalFace& face = face::canonical_face();
  Vec3 sum = Vec3::Zero();
  for (const bool left : {false, true}) {
    const Vec3 corner = face.landmark(left ? "ibug68_54" : "ibug68_48", face.mesh.points);
    const double share = std::exp(-(place - corner).squaredNorm() / (reach_m * reach_m));
    Vec3 way = kWholeSmile * (left ? smile.left : smile.right);
    if (!left) {
      way.x() = -way.x() + smile.dragged_right;
    }
    sum += share * way;
  }
  return sum;
}

/// 30 Hz, 3 s: rest, smile, hold, rest; the 68 points of iBUG in the canonical face's frame, or in
/// a head that turns by some degrees.
inline motion::Motion recording_of(const Smile& smile) {
  const face::CanonicalFace& face = face::canonical_face();
  motion::Motion motion;
  motion.source = "smile.csv";
  std::vector<Vec3> rest, way;
  for (int i = 0; i < 68; ++i) {
    motion.names.push_back(face::ibug(i));
    rest.push_back(face.landmark(motion.names.back(), face.mesh.points));
    way.push_back(smile_at(rest.back(), smile));
  }
  std::mt19937 random(smile.seed);
  std::normal_distribution<double> normal;
  const double phase = normal(random);
  const auto course = [](double u) {
    u = std::clamp(u, 0.0, 1.0);
    return u * u * u * (10 - 15 * u + 6 * u * u);
  };
  for (int k = 0; k < 90; ++k) {
    const double t = k / 30.0, g = course((t - 0.5) / 0.5) * course((2.7 - t) / 0.5);
    Eigen::Isometry3d head = Eigen::Isometry3d::Identity();
    if (smile.head_moves) {
      head = Eigen::AngleAxisd(0.06 * std::sin(2 * t + phase), Vec3::UnitY()) *
             Eigen::AngleAxisd(0.04 * std::sin(1.3 * t + phase), Vec3::UnitX());
      head.translation() = Vec3(0.004 * std::sin(t), 0.003 * t, 0.3);
    }
    Points at(68, 3);
    for (int i = 0; i < 68; ++i) {
      Vec3 p = head * Vec3(rest[std::size_t(i)] + g * way[std::size_t(i)]);
      for (int c = 0; c < 3; ++c) p[c] += smile.noise_m * normal(random);
      at.row(i) = p.transpose();
    }
    motion.time_s.push_back(t);
    motion.positions.push_back(at);
  }
  return motion;
}

inline VisitsFile visits_of(std::size_t count) {
  VisitsFile file;
  file.expression = expressions().front();
  for (std::size_t i = 0; i < count; ++i)
    file.visits.push_back({.label = "day " + std::to_string(i + 1),
                           .note = "",
                           .recordings = {},
                           .jitter_m = std::nullopt});
  return file;
}

inline const Measure& measure_named(const std::string& key, const std::string& side) {
  for (const Measure& one : measures())
    if (one.key == key && one.side == side) return one;
  throw std::invalid_argument(key);
}

}  // namespace hyperex::visits
