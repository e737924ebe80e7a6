// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <functional>
#include <limits>

#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {

/// State of live tracking. A delay is the time from the reception of a frame by the program
/// (Frame::arrived) to its completion, including the visitor. The camera's own delay is not
/// included.
struct LiveStatus {
  std::size_t frames = 0, valid = 0;  ///< number of finished frames
  std::size_t held_back = 0;  ///< processed by the network, but waiting for the person's shape
  std::size_t dropped = 0;    ///< by the source
  /// The frames among them that were lost until the buffered frames were finished.
  std::size_t dropped_while_learning = 0;
  double seconds = 0;  ///< from the first frame's arrival
  /// Rate of finished frames, by arrival time, over about the last second.
  double frames_a_second = 0;
  double delay_s = 0;           ///< of the last frame
  double learning_delay_s = 0;  ///< longest delay of the buffered frames
};

struct LiveOptions {
  /// A frame that arrives later than this (s) after the first is discarded, and tracking ends.
  double seconds = std::numeric_limits<double>::infinity();
  std::function<bool()> stop;                     ///< called before each frame
  std::function<void(const LiveStatus&)> status;  ///< called after each frame
  /// Called for each finished frame, in order, with the time of its arrival.
  std::function<void(const TrackedFrame&, std::chrono::steady_clock::time_point arrived)> finished;
  /// Whether frames and delays are kept for the result. False: for a camera without a planned end.
  bool keep = true;
};

struct LiveTracking {
  Tracking tracking;
  LiveStatus status;
  /// One entry per frame, for frames after the person's shape was known.
  std::vector<double> delays_s;
};

/// Tracks a live source (wrapped in LatestFrame, as open_source() does) until it ends or one of the
/// options ends it. At most TrackerOptions::neutral_frames frames are buffered with the results of
/// the network, and one frame waits in the source. While the buffered frames are being processed,
/// and whenever a frame takes longer than the camera's period, the source drops the frames in
/// between; the next frame is then the newest one. So the delay is at most the time for one frame
/// plus one period and does not accumulate. Times increase, and gaps in Frame::index show dropped
/// frames. Throws InputError if no frame shows a face.
LiveTracking track_live(capture::FrameSource& source, const expression::FaceModel& model,
                        const TrackerOptions& options, const LiveOptions& live,
                        const FrameVisitor& visit = {});

}  // namespace hyperex::tracking
