// SPDX-License-Identifier: GPL-3.0-or-later
#include "live.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/core/quantile.hpp"
#include "protocol.hpp"
#include "shape_message.hpp"

namespace hyperex::studio {

using nlohmann::json;

namespace {

constexpr auto kTellEach = std::chrono::milliseconds(200);
/// A page that is not visible draws nothing. A shape not drawn within this time counts as lost.
constexpr auto kLostAfter = std::chrono::seconds(1);
/// A gap is bridged by at most this number of steps.
constexpr int kMostStepsOfLive = 4;
constexpr std::size_t kDelays = 90;

double seconds_of(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

simulate::SimulationOptions live_options(simulate::SimulationOptions options) {
  options.drive.by = simulate::DriveBy::displacement;
  options.model.strain = simulate::Strain::linear;
  options.contact = {};
  return options;
}

std::vector<std::string> live_points() {
  std::vector<std::string> names;
  for (const auto& [name, vertices] : expression::canonical_model().landmarks)
    names.push_back(name);
  return names;
}

Live::Live(LiveSetup setup, Send send)
    : setup_(std::move(setup)), send_(std::move(send)), names_(live_points()), face_(setup_.face) {
  thread_ = std::thread([this] { run(); });
}

Live::~Live() {
  stop();
  thread_.join();
}

void Live::stop() {
  stopping_ = true;
}

void Live::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ended_.load(); });
}

bool Live::ended() const {
  return ended_;
}

void Live::run() {
  std::thread reenacting([this] { reenact_all(); });
  try {
    tracking::TrackerOptions options;
    options.network.mirrored_too = false;  // with a camera there is no time for it
    tracking::LiveOptions live;
    live.keep = false;
    live.stop = [this] { return stopping_.load(); };
    live.finished = [this](const tracking::TrackedFrame& frame, Clock::time_point arrived) {
      if (frame.valid) take(frame, arrived);
    };
    live.status = [this](const tracking::LiveStatus& status) {
      {
        const std::lock_guard lock(mutex_);
        status_ = status;
      }
      if (Clock::now() < status_sent_ + kTellEach) return;
      status_sent_ = Clock::now();
      send_status();
    };
    tracking::track_live(*setup_.source, expression::canonical_model(), options, live);
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    if (!stopping_) problem_ = error.what();
  }
  setup_.source.reset();
  {
    const std::lock_guard lock(mutex_);
    tracked_ = true;
  }
  changed_.notify_all();
  reenacting.join();
  record(false);
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  send_status();
  changed_.notify_all();
}

/// Runs on the tracker's thread: the next frame is tracked while this one is re-enacted.
void Live::take(const tracking::TrackedFrame& frame, Clock::time_point arrived) {
  LiveSample sample{frame.time_s,
                    expression::landmarks_on(expression::canonical_model(), frame.vertices_m)};
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    if (first_.size() < kFirst) first_.push_back(sample);
    recent_.push_back(sample);
    if (recent_.size() > kNeutral) recent_.pop_front();
    full = recording_ && !take_.empty() && sample.time_s - take_.front().time_s > kLongestTake_s;
    if (recording_ && !full) take_.push_back(sample);
    if (newest_ && neutral_.size() > 0) ++behind_;
    newest_ = {std::move(sample), arrived};
  }
  changed_.notify_all();
  if (full) record(false);
}

void Live::reenact_all() {
  try {
    for (;;) {
      Tracked next;
      std::deque<LiveSample> recent;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return tracked_ || newest_; });
        if (!newest_) return;
        next = std::move(*std::exchange(newest_, std::nullopt));
        if (first_.size() < kFirst) continue;
        if (!motion_ || want_neutral_) recent = motion_ ? recent_ : first_;
      }
      if (!motion_)
        begin(recent);
      else
        take_wishes(recent);
      reenact(next);
    }
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    problem_ = error.what();
    stopping_ = true;
  }
}

void Live::begin(const std::deque<LiveSample>& recent) {
  std::vector<double> times_s;
  for (const LiveSample& one : recent) times_s.push_back(one.time_s);
  interval_s_ = std::clamp(median_step(times_s), 1.0 / 240, 0.2);
  motion_.emplace(names_, recent, setup_.landmarks, setup_.method);
  simulator_.emplace(setup_.mesh, setup_.landmarks, motion_->at_rest(interval_s_), setup_.options);
  simulator_->start_stream(interval_s_);
  last_ = Points::Zero(motion_->neutral().rows(), 3);
  last_s_ = times_s.back() - interval_s_;
  const std::lock_guard lock(mutex_);
  neutral_ = motion_->neutral();
}

/// Carries out what other threads have requested, between two frames.
void Live::take_wishes(const std::deque<LiveSample>& recent) {
  std::optional<simulate::SimulationOptions> options;
  bool neutral = false;
  {
    const std::lock_guard lock(mutex_);
    options = std::exchange(want_options_, std::nullopt);
    neutral = std::exchange(want_neutral_, false) && !recent.empty();
  }
  if (!options && !neutral) return;
  std::string problem;
  try {
    if (options) {
      const bool same_stream = options->model.element == simulator_->options().model.element;
      simulator_->set_options(std::move(*options));
      if (!same_stream) simulator_->start_stream(interval_s_);
    }
    if (neutral) motion_.emplace(names_, recent, setup_.landmarks, setup_.method);
  } catch (const InputError& error) {
    problem = error.what();
  }
  const std::lock_guard lock(mutex_);
  neutral_ = motion_->neutral();
  problem_ = problem;
}

/// Dropped frames are replaced by linear interpolation between the tracked ones.
void Live::reenact(const Tracked& tracked) {
  const auto begun = Clock::now();
  const LiveSample& sample = tracked.sample;
  const Points now = motion_->displacement(sample);
  const int steps =
      std::clamp(int(std::lround((sample.time_s - last_s_) / interval_s_)), 1, kMostStepsOfLive);
  PointsF shape;
  for (int k = 1; k <= steps; ++k)
    shape = simulator_->step(last_ + (now - last_) * (double(k) / steps));
  last_ = now;
  last_s_ = sample.time_s;
  {
    const std::lock_guard lock(mutex_);
    step_s_ = seconds_of(Clock::now() - begun);
  }
  send_shape(shape, sample.time_s, tracked.arrived);
}

void Live::send_shape(const PointsF& shape, double time_s, Clock::time_point arrived) {
  std::size_t face = 0;
  ++frame_;
  {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    while (!ahead_.empty() && now - ahead_.front().sent > kLostAfter) ahead_.pop_front();
    if (ahead_.size() >= kAhead) {
      ++not_sent_;
      return;
    }
    ahead_.push_back({frame_, arrived, now});
    face = face_;
  }
  report::BinaryBlock block;
  json head = {{"event", "live_shape"}, {"face", face}, {"frame", frame_}, {"time_s", time_s}};
  add_shape(shape, block, head);
  send_(binary_message(head, block), true, "live_shape");
}

void Live::drawn(std::int64_t frame) {
  const std::lock_guard lock(mutex_);
  const auto one = std::find_if(ahead_.begin(), ahead_.end(),
                                [&](const Sent& sent) { return sent.frame == frame; });
  if (one == ahead_.end()) return;
  const auto now = Clock::now();
  delays_s_.push_back(seconds_of(now - one->arrived));
  if (delays_s_.size() > kDelays) delays_s_.pop_front();
  ahead_.erase(ahead_.begin(), one + 1);
  ++drawn_;
  drawn_at_.push_back(now);
  while (now - drawn_at_.front() > std::chrono::seconds(1)) drawn_at_.pop_front();
}

void Live::set_neutral() {
  const std::lock_guard lock(mutex_);
  want_neutral_ = true;
}

void Live::record(bool on) {
  {
    const std::lock_guard lock(mutex_);
    if (on && !ended_) {
      take_.clear();
      recording_ = true;
      return;
    }
    if (!std::exchange(recording_, false)) return;
  }
  send_take();
}

void Live::set_options(simulate::SimulationOptions options, std::size_t face) {
  const std::lock_guard lock(mutex_);
  want_options_ = std::move(options);
  face_ = face;
}

motion::Motion Live::take(double from_s, double to_s) const {
  const std::lock_guard lock(mutex_);
  if (take_.empty()) throw InputError("take", "none was recorded: expected one first");
  return motion_of_take(names_, take_, neutral_, from_s, to_s);
}

/// For each sample, the largest distance of a point from the neutral face, by which the user trims
/// the take.
void Live::send_take() {
  json event = {{"event", "take"}, {"time_s", json::array()}, {"moved_mm", json::array()}};
  {
    const std::lock_guard lock(mutex_);
    for (const LiveSample& one : take_) {
      event["time_s"].push_back(one.time_s - take_.front().time_s);
      event["moved_mm"].push_back(1e3 * (one.positions - neutral_).rowwise().norm().maxCoeff());
    }
  }
  send_(event.dump(), false, "take");
}

void Live::send_status() {
  json event;
  {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    while (!drawn_at_.empty() && now - drawn_at_.front() > std::chrono::seconds(1))
      drawn_at_.pop_front();
    std::vector<double> delays_s(delays_s_.begin(), delays_s_.end());
    std::ranges::sort(delays_s);
    const auto delay_ms = [&](double share) -> json {
      if (delays_s.empty()) return nullptr;
      return 1e3 * quantile_of_sorted(delays_s, share);
    };
    const char* state = ended_                  ? "ended"
                        : neutral_.size() > 0   ? "following"
                        : status_.held_back > 0 ? "learning"
                                                : "looking";
    event = {{"event", "live"},
             {"state", state},
             {"problem", problem_},
             {"frames", status_.frames},
             {"valid", status_.valid},
             {"dropped", status_.dropped + behind_},
             {"not_drawn", not_sent_},
             {"drawn", drawn_},
             {"drawn_a_second", drawn_at_.size()},
             {"delay_ms", delay_ms(0.5)},
             {"delay_95_ms", delay_ms(0.95)},
             {"step_ms", 1e3 * step_s_},
             {"recording", recording_},
             {"take_s", take_.empty() ? 0.0 : take_.back().time_s - take_.front().time_s}};
  }
  send_(event.dump(-1, ' ', false, json::error_handler_t::replace), false, "live");
}

}  // namespace hyperex::studio
