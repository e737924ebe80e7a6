// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/track_live.hpp"

#include <deque>

#include "hyperex/core/error.hpp"

namespace hyperex::tracking {
namespace {
using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// The data of a frame that are needed until it is finished.
struct Fed {
  Clock::time_point arrived;
  cv::Mat bgr;
};

class LiveTracker {
 public:
  LiveTracker(const expression::FaceModel& model, const capture::Intrinsics& camera,
              const TrackerOptions& options, const LiveOptions& live, const FrameVisitor& visit)
      : tracker_(model, camera, options), live_(live), visit_(visit) {}

  void feed(const capture::Frame& frame, std::size_t dropped) {
    if (!first_) first_ = frame.arrived;
    fed_.push_back({frame.arrived, visit_ ? frame.colour : cv::Mat()});
    const bool learning = !tracker_.neutral();
    keep(tracker_.feed(frame), learning);
    result_.status.held_back = fed_.size();
    result_.status.seconds = seconds_between(*first_, Clock::now());
    result_.status.dropped = dropped;
    if (!learnt_) result_.status.dropped_while_learning = dropped;
    learnt_ = !learning;  // frames dropped during this call are reported with the next frame
  }

  LiveTracking finish(std::size_t dropped) {
    const bool learning = !tracker_.neutral();
    keep(tracker_.finish(), learning);
    if (!tracker_.neutral()) throw InputError("tracking", "no face was found in any of the frames");
    result_.status.held_back = 0;
    result_.status.dropped = dropped;
    result_.tracking.neutral = tracker_.neutral();
    result_.tracking.times = tracker_.times();
    return std::move(result_);
  }

  const LiveStatus& status() const { return result_.status; }
  double seconds_to(Clock::time_point time) const {
    return first_ ? seconds_between(*first_, time) : 0;
  }

 private:
  void keep(std::vector<TrackedFrame> frames, bool learning) {
    LiveStatus& status = result_.status;
    for (auto& frame : frames) {
      if (visit_) visit_(frame, fed_.front().bgr);
      if (live_.finished) live_.finished(frame, fed_.front().arrived);
      const auto now = Clock::now();
      status.delay_s = seconds_between(fed_.front().arrived, now);
      if (learning)
        status.learning_delay_s = std::max(status.learning_delay_s, status.delay_s);
      else if (live_.keep)
        result_.delays_s.push_back(status.delay_s);
      count_rate(fed_.front().arrived);
      fed_.pop_front();
      ++status.frames;
      status.valid += frame.valid;
      if (live_.keep) result_.tracking.frames.push_back(std::move(frame));
    }
  }

  /// By arrival time, because buffered frames are finished all at once.
  void count_rate(Clock::time_point arrived) {
    last_second_.push_back(arrived);
    while (seconds_between(last_second_.front(), arrived) > 1) last_second_.pop_front();
    const double span_s = seconds_between(last_second_.front(), arrived);
    if (span_s > 0) result_.status.frames_a_second = double(last_second_.size() - 1) / span_s;
  }

  FaceTracker tracker_;
  const LiveOptions& live_;
  const FrameVisitor& visit_;
  LiveTracking result_;
  std::deque<Fed> fed_;                        // not finished yet
  std::deque<Clock::time_point> last_second_;  // arrivals of finished frames
  bool learnt_ = false;
  std::optional<Clock::time_point> first_;
};

}  // namespace

LiveTracking track_live(capture::FrameSource& source, const expression::FaceModel& model,
                        const TrackerOptions& options, const LiveOptions& live,
                        const FrameVisitor& visit) {
  LiveTracker tracker(model, source.intrinsics(), options, live, visit);
  while (!live.stop || !live.stop()) {
    const auto frame = source.next();
    if (!frame || tracker.seconds_to(frame->arrived) > live.seconds) break;
    tracker.feed(*frame, source.dropped());
    if (live.status) live.status(tracker.status());
  }
  return tracker.finish(source.dropped());
}

}  // namespace hyperex::tracking
