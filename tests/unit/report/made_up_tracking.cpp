// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/report/made_up_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyperex::report::testing {
namespace {

using expression::FaceModel;
using tracking::TrackedFrame;

Eigen::Isometry3d pose_at(double t) {
  constexpr double kRadians = std::numbers::pi / 180;
  // The camera looks along the face's -z, its y down.
  const Eigen::AngleAxisd facing(std::numbers::pi, Vec3::UnitX());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (facing * Eigen::AngleAxisd(20 * kRadians * std::sin(1.1 * t), Vec3::UnitY()) *
                   Eigen::AngleAxisd(-8 * kRadians * std::sin(1.7 * t), Vec3::UnitX()) *
                   Eigen::AngleAxisd(5 * kRadians * std::sin(0.9 * t), Vec3::UnitZ()))
                      .toRotationMatrix();
  pose.translation() = Vec3(0.02 * std::sin(0.7 * t), 0.01 * std::cos(t), 0.6 + 0.03 * std::sin(t));
  return pose;
}

Eigen::VectorXd weights_at(const FaceModel& model, double t) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(Eigen::Index(model.animation_units.size()));
  const auto set = [&](const char* name, double value) {
    weights[model.animation_unit(name)] = value;
  };
  set("jawOpen", 0.3 - 0.3 * std::cos(2.6 * t));
  set("mouthSmile_L", std::max(0.0, 0.7 * std::sin(0.8 * t)));
  set("mouthSmile_R", std::max(0.0, 0.4 * std::sin(0.8 * t)));
  const double blink = std::pow(std::max(0.0, std::cos(1.9 * t + 1)), 24);
  set("eyeBlink_L", blink);
  set("eyeBlink_R", 0.9 * blink);
  set("browInnerUp_L", 0.2 * std::sin(0.5 * t));
  set("cheekPuff_L", 0.02 * std::sin(3 * t));
  return weights;
}

}  // namespace

tracking::Tracking made_up_tracking(int frames, bool with_depth) {
  const FaceModel& model = expression::canonical_model();
  tracking::Tracking tracking;
  tracking.neutral = tracking::Neutral{model.mesh.points, 1, {}, with_depth};
  for (int k = 0; k < frames; ++k) {
    TrackedFrame frame;
    frame.index = std::size_t(k);
    frame.time_s = 5 + k / 30.0;
    const double t = k / 30.0;
    if ((k >= 40 && k < 50) || k == 60) {
      frame.fault = k == 60 ? "rgb/60.jpg: torn" : "no face found";
      tracking.frames.push_back(frame);
      continue;
    }
    frame.valid = true;
    frame.camera_from_head = pose_at(t);
    frame.weights = weights_at(model, t);
    frame.vertices_m = deformed(model.mesh.points, model.animation_units, frame.weights);
    frame.report.network_rms_px = 1.5 + 0.5 * std::sin(2 * t);
    if (with_depth) {
      frame.report.depth_rms_m = 0.0012 + 0.0003 * std::cos(3 * t);
      frame.report.depth_share = 0.9 + 0.05 * std::sin(t);
    }
    frame.report.photometric_share = k == 0 ? 0 : 0.8;
    tracking.frames.push_back(frame);
  }
  return tracking;
}

}  // namespace hyperex::report::testing
