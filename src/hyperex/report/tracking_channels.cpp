// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/tracking_channels.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "hyperex/face/ibug.hpp"

namespace hyperex::report {
namespace {

using expression::FaceModel;
using tracking::TrackedFrame;
using tracking::Tracking;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Collects channels; `value` is called for valid frames only.
class Collector {
 public:
  Collector(const Tracking& tracking, TrackingCurves& curves)
      : tracking_(tracking), curves_(curves) {}

  void add(std::string group, std::string name, std::string unit,
           const std::function<double(const TrackedFrame&)>& value, std::string facs = {}) {
    TrackingChannel channel{
        std::move(group), std::move(name), std::move(facs), std::move(unit), {}};
    channel.values.reserve(curves_.frames.size());
    for (const std::size_t row : curves_.frames) {
      const TrackedFrame& frame = tracking_.frames[row];
      channel.values.push_back(frame.valid ? value(frame) : kNan);
    }
    curves_.channels.push_back(std::move(channel));
  }

 private:
  const Tracking& tracking_;
  TrackingCurves& curves_;
};

void choose_frames(const Tracking& tracking, TrackingCurves& curves) {
  const std::size_t count = tracking.frames.size();
  std::vector<double> next_valid_s(count, kInfinity);  // of the frames after it
  for (std::size_t k = count; k-- > 1;)
    next_valid_s[k - 1] = tracking.frames[k].valid ? tracking.frames[k].time_s : next_valid_s[k];
  double last_s = -kInfinity;
  for (std::size_t k = 0; k < count; ++k) {
    const TrackedFrame& frame = tracking.frames[k];
    if (!std::isfinite(frame.time_s) || frame.time_s <= last_s) continue;
    if (!frame.valid && frame.time_s >= next_valid_s[k]) continue;
    if (frame.valid && curves.reference < 0) curves.reference = int(curves.frames.size());
    curves.frames.push_back(k);
    curves.time_s.push_back(last_s = frame.time_s);
  }
}

void add_pose(Collector& collect, const Eigen::Isometry3d& camera_from_first) {
  const Eigen::Isometry3d first_from_camera = camera_from_first.inverse();
  const auto turn = [=](const TrackedFrame& frame) {
    return head_turn((first_from_camera * frame.camera_from_head).linear());
  };
  collect.add("turn", "yaw", "deg", [=](const auto& f) { return turn(f).yaw_deg; });
  collect.add("turn", "pitch", "deg", [=](const auto& f) { return turn(f).pitch_deg; });
  collect.add("turn", "roll", "deg", [=](const auto& f) { return turn(f).roll_deg; });
  static const char* axes[] = {"left", "up", "forward"};
  for (int axis = 0; axis < 3; ++axis)
    collect.add("shift", axes[axis], "mm", [=](const TrackedFrame& frame) {
      return 1e3 * (first_from_camera * frame.camera_from_head).translation()[axis];
    });
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The mean distance of the pairs; nothing where the model has not all of the points.
void add_distance(Collector& collect, const FaceModel& model, const std::string& name,
                  const Pairs& pairs) {
  std::vector<std::pair<std::vector<int>, std::vector<int>>> ends;
  for (const auto& [a, b] : pairs) {
    const auto first = model.landmarks.find(a), second = model.landmarks.find(b);
    if (first == model.landmarks.end() || second == model.landmarks.end()) return;
    ends.emplace_back(first->second, second->second);
  }
  collect.add("distance", name, "mm", [&](const TrackedFrame& frame) {
    double sum_m = 0;
    for (const auto& [a, b] : ends)
      sum_m += (expression::landmark_at(a, frame.vertices_m) -
                expression::landmark_at(b, frame.vertices_m))
                   .norm();
    return 1e3 * sum_m / double(ends.size());
  });
}

void add_travel(Collector& collect, const FaceModel& model, const Points& rest_m,
                const std::string& name, const std::string& landmark) {
  const auto found = model.landmarks.find(landmark);
  if (found == model.landmarks.end()) return;
  const Vec3 at_rest = expression::landmark_at(found->second, rest_m);
  collect.add("distance", name, "mm", [&](const TrackedFrame& frame) {
    return 1e3 * (expression::landmark_at(found->second, frame.vertices_m) - at_rest).norm();
  });
}

void add_distances(Collector& collect, const FaceModel& model, const Points& rest_m) {
  add_distance(collect, model, "mouth opening", {{face::ibug(62), face::ibug(66)}});
  add_distance(collect, model, "mouth width", {{"cheilion_R", "cheilion_L"}});
  add_travel(collect, model, rest_m, "mouth corner's travel L", "cheilion_L");
  add_travel(collect, model, rest_m, "mouth corner's travel R", "cheilion_R");
  add_distance(collect, model, "eye opening L",
               {{face::ibug(43), face::ibug(47)}, {face::ibug(44), face::ibug(46)}});
  add_distance(collect, model, "eye opening R",
               {{face::ibug(37), face::ibug(41)}, {face::ibug(38), face::ibug(40)}});
}

void add_residuals(Collector& collect) {
  collect.add("residual", "network", "px", [](const auto& f) { return f.report.network_rms_px; });
  collect.add("residual", "depth", "mm", [](const TrackedFrame& frame) {
    return frame.report.depth_share > 0 ? 1e3 * frame.report.depth_rms_m : kNan;
  });
  collect.add("residual", "depth seen", "%",
              [](const auto& f) { return 100 * f.report.depth_share; });
  collect.add("residual", "skin matched", "%", [](const TrackedFrame& frame) {
    const double share = frame.report.photometric_share;
    return share > 0 ? 100 * share : kNan;
  });
}

void check_tracking(const FaceModel& model, const Tracking& tracking) {
  const auto wrong = [&](const TrackedFrame& frame) {
    return frame.valid && (frame.weights.size() != Eigen::Index(model.animation_units.size()) ||
                           frame.vertices_m.rows() != model.vertex_count());
  };
  if (!tracking.neutral || tracking.neutral->points_m.rows() != model.vertex_count() ||
      std::any_of(tracking.frames.begin(), tracking.frames.end(), wrong))
    throw std::invalid_argument("tracking_curves: the tracking is not of this model");
}

}  // namespace

HeadTurn head_turn(const Eigen::Matrix3d& r) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  return {kDegrees * std::atan2(r(0, 2), r(2, 2)),
          kDegrees * std::asin(std::clamp(r(1, 2), -1.0, 1.0)),
          -kDegrees * std::atan2(r(1, 0), r(1, 1))};
}

TrackingCurves tracking_curves(const FaceModel& model, const Tracking& tracking) {
  check_tracking(model, tracking);
  TrackingCurves curves;
  choose_frames(tracking, curves);
  Collector collect(tracking, curves);
  const auto reference = std::size_t(std::max(curves.reference, 0));
  add_pose(collect, curves.reference < 0
                        ? Eigen::Isometry3d::Identity()
                        : tracking.frames[curves.frames[reference]].camera_from_head);
  add_distances(collect, model, tracking.neutral->points_m);
  for (std::size_t k = 0; k < model.animation_units.size(); ++k)
    collect.add(
        "unit", model.animation_units[k].name, "",
        [k](const auto& f) { return f.weights[Eigen::Index(k)]; }, model.animation_units[k].facs);
  add_residuals(collect);
  return curves;
}

}  // namespace hyperex::report
