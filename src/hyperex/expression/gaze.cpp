// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/gaze.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/motion/rest.hpp"

namespace hyperex::expression {
namespace {

using Eigen::Index;

constexpr double kDeg = std::numbers::pi / 180;

Gaze between(const Gaze& a, const Gaze& b, double share) {
  return {std::lerp(a.up_rad, b.up_rad, share), std::lerp(a.left_rad, b.left_rad, share)};
}

bool is_known(const EyesGaze& gaze) {
  return std::isfinite(gaze.right.up_rad) && std::isfinite(gaze.right.left_rad) &&
         std::isfinite(gaze.left.up_rad) && std::isfinite(gaze.left.left_rad);
}

EyesGaze by_angles(const BlendShapes& shapes, Index sample) {
  const auto row = shapes.eye_angles_rad.row(sample);
  const auto eye = [](double yaw_rad, double pitch_rad) { return Gaze{-pitch_rad, -yaw_rad}; };
  return {eye(row[2], row[3]), eye(row[0], row[1])};
}

EyesGaze by_weights(const BlendShapes& shapes, Index sample) {
  EyesGaze sum;
  for (std::size_t c = 0; c < shapes.names.size(); ++c) {
    const std::optional<Gaze> whole = gaze_of_shape(shapes.names[c]);
    if (!whole) continue;
    const double weight = shapes.weights(sample, Index(c));
    Gaze& eye = shapes.names[c].ends_with("Left") ? sum.left : sum.right;
    eye.up_rad += weight * whole->up_rad;
    eye.left_rad += weight * whole->left_rad;
  }
  return sum;
}

bool have_gaze(const BlendShapes& shapes) {
  for (std::size_t c = 0; c < shapes.names.size(); ++c)
    if (is_gaze(shapes.names[c]) && (shapes.weights.col(Index(c)).array() > 0).any()) return true;
  return false;
}

}  // namespace

std::array<double, 4> degrees_of(const EyesGaze& gaze) {
  const auto& [right, left] = gaze;
  return {right.left_rad / kDeg, right.up_rad / kDeg, left.left_rad / kDeg, left.up_rad / kDeg};
}

Eigen::Quaterniond turn_of(const Gaze& gaze, const Vec3& ahead, const Vec3& across) {
  const Vec3 left = (across - across.dot(ahead) * ahead).normalized();
  return Eigen::Quaterniond(Eigen::AngleAxisd(gaze.left_rad, ahead.cross(left)) *
                            Eigen::AngleAxisd(-gaze.up_rad, left));
}

bool is_gaze(const std::string& shape) {
  return shape.starts_with("eyeLook");
}

std::optional<Gaze> gaze_of_shape(const std::string& shape) {
  const double outward = shape.ends_with("Left") ? 1 : -1;
  if (shape.starts_with("eyeLookUp")) return Gaze{kLookUp_deg * kDeg, 0};
  if (shape.starts_with("eyeLookDown")) return Gaze{-kLookDown_deg * kDeg, 0};
  if (shape.starts_with("eyeLookOut")) return Gaze{0, outward * kLookAside_deg * kDeg};
  if (shape.starts_with("eyeLookIn")) return Gaze{0, -outward * kLookAside_deg * kDeg};
  return std::nullopt;
}

BlendShapes with_lids_once(BlendShapes shapes) {
  const auto column = [&](const std::string& name) {
    return Index(std::ranges::find(shapes.names, name) - shapes.names.begin());
  };
  for (const std::string side : {"Left", "Right"})
    for (const auto& [gaze, lids, share] : {std::tuple{"eyeLookDown", "eyeBlink", kBlinkOfLookDown},
                                            {"eyeLookUp", "eyeWide", kWideOfLookUp}}) {
      const Index follows = column(gaze + side), moved = column(lids + side);
      if (follows == shapes.weights.cols() || moved == shapes.weights.cols()) continue;
      for (Index k = 0; k < shapes.weights.rows(); ++k) {
        double& weight = shapes.weights(k, follows);
        const double lowered = shapes.weights(k, moved);
        const double rest = weight - share * (lowered < 0 ? 0 : lowered);
        weight = rest < 0 ? 0 : rest;  // not std::max: what was not measured stays so
      }
    }
  return shapes;
}

EyesGaze GazeTrack::at(double t_s) const {
  const auto after = std::ranges::upper_bound(time_s, t_s);
  if (after == time_s.begin()) return gaze.front();
  if (after == time_s.end()) return gaze.back();
  const auto i = std::size_t(after - time_s.begin());
  const double share = (t_s - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
  return {between(gaze[i - 1].right, gaze[i].right, share),
          between(gaze[i - 1].left, gaze[i].left, share)};
}

GazeTrack led_in(const GazeTrack& track, double start_s, double lead_s) {
  constexpr int steps = 30;
  const EyesGaze ahead, first = track.at(start_s);
  GazeTrack out;
  for (int k = 0; k <= steps; ++k) {
    const double u = double(k) / steps, share = motion::lead_course(u);
    out.time_s.push_back(start_s - lead_s * (1 - u));
    out.gaze.push_back(
        {between(ahead.right, first.right, share), between(ahead.left, first.left, share)});
  }
  for (std::size_t k = 0; k < track.time_s.size(); ++k)
    if (track.time_s[k] > start_s) {
      out.time_s.push_back(track.time_s[k]);
      out.gaze.push_back(track.gaze[k]);
    }
  return out;
}

std::optional<GazeTrack> gaze_of(const BlendShapes& shapes) {
  const bool angles = shapes.eye_angles_rad.cols() > 0;
  if (!angles && !have_gaze(shapes)) return std::nullopt;
  GazeTrack track;
  for (std::size_t k = 0; k < shapes.time_s.size(); ++k) {
    const EyesGaze gaze = angles ? by_angles(shapes, Index(k)) : by_weights(shapes, Index(k));
    if (!is_known(gaze)) continue;
    track.time_s.push_back(shapes.time_s[k]);
    track.gaze.push_back(gaze);
  }
  return track.time_s.empty() ? std::nullopt : std::optional(std::move(track));
}

}  // namespace hyperex::expression
