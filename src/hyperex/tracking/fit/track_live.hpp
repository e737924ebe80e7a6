// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <functional>
#include <limits>

#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {

/// How live tracking goes. Delays run from when the program had a frame in hand (Frame::arrived) to
/// when all is done with it, the visitor's work included; what the camera itself takes is not in.
struct LiveStatus {
  std::size_t frames = 0, valid = 0;       ///< finished
  std::size_t held_back = 0;               ///< seen, but waiting for the person's shape
  std::size_t dropped = 0;                 ///< by the source
  std::size_t dropped_while_learning = 0;  ///< the work on what was held back included
  double seconds = 0;                      ///< from the first frame's arrival
  double frames_a_second = 0;   ///< of those finished, by their arrival in about the last second
  double delay_s = 0;           ///< of the last frame
  double learning_delay_s = 0;  ///< the longest among the frames that were held back
};

struct LiveOptions {
  /// Frames that arrive later after the first are left out, and tracking ends.
  double seconds = std::numeric_limits<double>::infinity();
  std::function<bool()> stop;                     ///< called before each frame
  std::function<void(const LiveStatus&)> status;  ///< called after each frame
  /// Told of each frame once it is finished, in order, and of when it arrived.
  std::function<void(const TrackedFrame&, std::chrono::steady_clock::time_point arrived)> finished;
  /// Frames and delays are kept for the result; false: for a camera without end.
  bool keep = true;
};

struct LiveTracking {
  Tracking tracking;
  LiveStatus status;
  std::vector<double> delays_s;  ///< a frame each, of those after the person's shape was known
};

/// Tracks a live source (wrapped in LatestFrame, as open_source() does) until it ends or one of the
/// options says so. At most TrackerOptions::neutral_frames frames are held back with what the
/// network saw in them, and one waits in the source: while those held back are worked off, as
/// whenever a frame takes longer than the camera's period, the source drops what comes in between,
/// and the next frame is the newest one. So the delay is bounded by the work for one frame and a
/// period, and nothing adds up. Times rise and Frame::index shows where frames are missing. Throws
/// InputError where no frame shows a face.
LiveTracking track_live(capture::FrameSource& source, const expression::FaceModel& model,
                        const TrackerOptions& options, const LiveOptions& live,
                        const FrameVisitor& visit = {});

}  // namespace hyperex::tracking
