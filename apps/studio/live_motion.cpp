// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_motion.hpp"

#include <numeric>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/rest.hpp"
#include "hyperex/motion/stabilise.hpp"

namespace hyperex::studio {

namespace {

Points mean_of(const std::deque<LiveSample>& samples) {
  Points sum = samples.front().positions;
  for (std::size_t k = 1; k < samples.size(); ++k) sum += samples[k].positions;
  return sum / double(samples.size());
}

motion::ExpressivePoseStream poses_of(const std::vector<std::string>& names, const Points& neutral,
                                      const std::deque<LiveSample>& samples) {
  motion::Motion seen;
  seen.names = names;
  seen.source = "live";
  for (const LiveSample& one : samples) {
    seen.time_s.push_back(one.time_s);
    seen.positions.push_back(one.positions);
  }
  std::vector<int> all(names.size());
  std::iota(all.begin(), all.end(), 0);
  const double jitter_m = motion::jitter_of_differences(seen, all);
  seen.positions = {neutral};
  seen.time_s.resize(1);
  return {std::move(seen), jitter_m};
}

}  // namespace

LiveMotion::LiveMotion(std::vector<std::string> names, const std::deque<LiveSample>& neutral,
                       io::Landmarks landmarks, simulate::AlignmentMethod method)
    : names_(std::move(names)),
      neutral_(mean_of(neutral)),
      landmarks_(std::move(landmarks)),
      method_(method),
      poses_(poses_of(names_, neutral_, neutral)) {
  static_cast<void>(at_rest(1));
}

simulate::AlignedMotion LiveMotion::at_rest(double interval_s) const {
  motion::Motion rest;
  rest.names = names_;
  rest.time_s = {0, interval_s};
  rest.positions = {neutral_, neutral_};
  rest.source = "live";
  return simulate::align(rest, landmarks_, method_);
}

Points LiveMotion::displacement(const LiveSample& sample) {
  const Eigen::Isometry3d back = poses_.pose(sample.time_s, sample.positions).inverse();
  motion::Motion now;
  now.names = names_;
  now.source = "live";
  now.time_s = {0, 1};
  now.positions = {neutral_, (sample.positions * back.linear().transpose()).rowwise() +
                                 back.translation().transpose()};
  const simulate::AlignedMotion aligned = simulate::align(now, landmarks_, method_);
  return aligned.motion.positions.back() - aligned.rest;
}

motion::Motion motion_of_take(const std::vector<std::string>& names,
                              const std::vector<LiveSample>& samples, const Points& neutral,
                              double from_s, double to_s) {
  motion::Motion seen;
  seen.names = names;
  seen.source = "take";
  // The neutral face comes first, since the head pose is relative to the first sample.
  seen.time_s = {0};
  seen.positions = {neutral};
  for (const LiveSample& one : samples) {
    const double since_s = one.time_s - samples.front().time_s;
    if (since_s < from_s - 1e-9 || since_s > to_s + 1e-9) continue;
    seen.time_s.push_back(1 + since_s - from_s);
    seen.positions.push_back(one.positions);
  }
  if (seen.time_s.size() < 3)
    throw InputError("take", "fewer than two frames with a face are left: expected a longer one");
  motion::Motion steady = motion::stabilise(seen).motion;
  steady.head_pose.clear();
  // Then it is moved to the end, as the stretch at rest for with_rest().
  const auto rotate = [](auto& list) {
    list.push_back(list.front());
    list.erase(list.begin());
  };
  rotate(steady.positions);
  steady.time_s.erase(steady.time_s.begin());
  const double first_s = steady.time_s.front();
  steady.time_s.push_back(steady.time_s.back() + 1);
  const double rest_s = steady.time_s.back() - first_s;
  motion::Motion led = motion::with_rest(steady, {rest_s, rest_s}).motion;
  led.time_s.pop_back();
  led.positions.pop_back();
  const double start_s = led.time_s.front();
  for (double& time_s : led.time_s) time_s -= start_s;
  return led;
}

}  // namespace hyperex::studio
