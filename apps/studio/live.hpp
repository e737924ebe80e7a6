// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A face that follows a camera, or a recording played in its place, while frames arrive.
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
  simulate::SimulationOptions options;  ///< from live_options()
  std::size_t face = 0;                 ///< the number of the face that is drawn
};

/// Options suitable for a stream: driven by displacements, small strain, no contact.
simulate::SimulationOptions live_options(simulate::SimulationOptions options);

/// The names of the points that are tracked.
std::vector<std::string> live_points();

/// Tracks, re-enacts and sends each frame (event live_shape) on two threads of its own, and reports
/// its state (event live). Nothing queues up: the source drops frames while the tracker is busy,
/// only the newest tracked frame is re-enacted, and at most kAhead shapes wait to be drawn; further
/// ones are not sent. The neutral face is the mean of the first kFirst frames, in which the face is
/// assumed to be at rest, until set_neutral() is called.
class Live {
 public:
  using Send = std::function<void(std::string message, bool binary, const std::string& replaces)>;
  static constexpr std::size_t kFirst = 5, kNeutral = 10, kAhead = 2;
  static constexpr double kLongestTake_s = 300;

  Live(LiveSetup setup, Send send);
  ~Live();  ///< stops, after the current frame
  Live(const Live&) = delete;

  // From any thread:
  void stop();
  void wait();  ///< until it has ended
  bool ended() const;
  /// From now on the neutral face is the mean of the last kNeutral frames.
  void set_neutral();
  /// Starts another take, or ends the one that is being recorded and sends it (event take).
  void record(bool on);
  /// The page has drawn the shape of this number.
  void drawn(std::int64_t frame);
  /// Sets another face, or another tissue.
  void set_options(simulate::SimulationOptions options, std::size_t face);
  /// The part of the last take from `from_s` to `to_s` as a scene's motion. Throws InputError where
  /// there is none.
  motion::Motion take(double from_s, double to_s) const;
  void send_status();

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

  Clock::time_point status_sent_{};  // time of the last event live; tracker's thread only
  // Used only by the thread that re-enacts:
  std::optional<LiveMotion> motion_;
  std::optional<simulate::Simulator> simulator_;
  Points last_;  // displacement
  double last_s_ = 0, interval_s_ = 0;
  std::int64_t frame_ = 0;

  mutable std::mutex mutex_;  // protects all members below
  std::condition_variable changed_;
  bool tracked_ = false, want_neutral_ = false, recording_ = false;
  std::deque<LiveSample> first_, recent_;  // the first kFirst, and the last kNeutral samples
  std::optional<Tracked> newest_;          // the next one to be re-enacted
  std::optional<simulate::SimulationOptions> want_options_;
  std::size_t face_ = 0;
  Points neutral_;  // of the motion
  std::vector<LiveSample> take_;
  tracking::LiveStatus status_;
  std::deque<Sent> ahead_;
  std::deque<Clock::time_point> drawn_at_;  // times at which shapes were drawn, in the last second
  std::deque<double> delays_s_;             // from a frame's arrival to its drawing
  std::size_t behind_ = 0, not_sent_ = 0, drawn_ = 0;
  double step_s_ = 0;
  std::string problem_;

  std::thread thread_;
};

}  // namespace hyperex::studio
