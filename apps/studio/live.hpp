// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A face that follows a camera, or a recording played as one, while frames come in.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hyperex/capture/source.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tracking/fit/track_live.hpp"
#include "live_motion.hpp"

namespace hyperex::studio {

struct LiveSetup {
  std::unique_ptr<capture::FrameSource> source;  ///< live: wrapped in LatestFrame
  std::shared_ptr<const tissue::TissueMesh> mesh;
  io::Landmarks landmarks;
  simulate::AlignmentMethod method = simulate::AlignmentMethod::nonrigid;
  simulate::SimulationOptions options;  ///< live_options() of what the face is
  std::size_t face = 0;                 ///< which is drawn
};

/// Options as a stream takes them: driven by displacements, of small strain, without contact.
simulate::SimulationOptions live_options(simulate::SimulationOptions options);

/// Names of what is tracked.
std::vector<std::string> live_points();

/// Tracks, re-enacts and sends each frame (event live_shape) on two threads of its own, and tells
/// how it goes (event live). Nothing queues up: the source drops what the tracker is too slow for,
/// of tracked frames the newest is re-enacted, and of shapes at most kAhead wait to be drawn, later
/// ones are not sent. The neutral face is the mean of the first kFirst frames, which the tracker
/// takes to be at rest, until it is set.
class Live {
 public:
  using Send = std::function<void(std::string message, bool binary, const std::string& replaces)>;
  static constexpr std::size_t kFirst = 5, kNeutral = 10, kAhead = 2;
  static constexpr double kLongestTake_s = 300;

  Live(LiveSetup setup, Send send);
  ~Live();  ///< ends it, after the frame it is at
  Live(const Live&) = delete;

  // From any thread:
  void stop();
  void wait();  ///< until it has ended
  bool ended() const;
  /// The mean of the last kNeutral frames is the neutral face from now on.
  void set_neutral();
  /// Another take begins, or the one that is recorded ends and is told (event take).
  void record(bool on);
  /// The page has drawn a shape, by its number.
  void drawn(std::int64_t frame);
  /// The face is another, or of other tissue.
  void set_options(simulate::SimulationOptions options, std::size_t face);
  /// The last take as a scene's motion. Throws InputError where there is none.
  motion::Motion take(double from_s, double to_s) const;
  void tell();

 private:
  using Clock = std::chrono::steady_clock;
  struct Sent {
    std::int64_t frame;
    Clock::time_point arrived, sent;
  };
  struct Tracked {
    LiveSample sample;
    Clock::time_point arrived;
  };
  void run();
  void take(const tracking::TrackedFrame& frame, Clock::time_point arrived);
  void reenact_all();
  void begin(const std::deque<LiveSample>& recent);
  void take_wishes(const std::deque<LiveSample>& recent);
  void reenact(const Tracked& tracked);
  void send_shape(const PointsF& shape, double time_s, Clock::time_point arrived);
  void send_take();

  LiveSetup setup_;
  Send send_;
  const std::vector<std::string> names_;
  std::atomic<bool> stopping_{false}, ended_{false};

  Clock::time_point told_{};  // of the tracker's thread
  // Of the thread that re-enacts:
  std::optional<LiveMotion> motion_;
  std::optional<simulate::Simulator> simulator_;
  Points last_;  // displacement
  double last_s_ = 0, interval_s_ = 0;
  std::int64_t frame_ = 0;

  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  bool tracked_ = false, want_neutral_ = false, recording_ = false;
  std::deque<LiveSample> first_, recent_;  // kFirst, and the last kNeutral at most
  std::optional<Tracked> newest_;          // waits to be re-enacted
  std::optional<simulate::SimulationOptions> want_options_;
  std::size_t face_ = 0;
  Points neutral_;  // of the motion
  std::vector<LiveSample> take_;
  tracking::LiveStatus status_;
  std::deque<Sent> ahead_;
  std::deque<Clock::time_point> drawn_at_;  // in the last second
  std::deque<double> delays_s_;             // to pixels, of the last frames
  std::size_t behind_ = 0, not_sent_ = 0, drawn_ = 0;
  double step_s_ = 0;
  std::string problem_;

  std::thread thread_;
};

}  // namespace hyperex::studio
