// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/track_source.hpp"

#include <deque>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"

namespace hyperex::tracking {

Tracking track(capture::FrameSource& source, const FaceModel& model, const TrackerOptions& options,
               const FrameVisitor& visit) {
  FaceTracker tracker(model, source.intrinsics(), options);
  Tracking tracking;
  std::deque<cv::Mat> pictures;  // of the frames that are not finished
  Progress progress("tracking", long(source.frame_count().value_or(0)));
  const auto keep = [&](std::vector<TrackedFrame> frames) {
    for (auto& frame : frames) {
      if (visit) {
        visit(frame, pictures.front());
        pictures.pop_front();
      }
      tracking.frames.push_back(std::move(frame));
    }
  };
  long done = 0;
  while (const auto frame = source.next()) {
    if (visit) pictures.push_back(frame->colour);
    keep(tracker.feed(*frame));
    progress.update(++done);
  }
  keep(tracker.finish());
  tracking.neutral = tracker.neutral();
  tracking.times = tracker.times();
  if (!tracking.neutral) throw InputError("tracking", "no face was found in any of the frames");
  return tracking;
}

}  // namespace hyperex::tracking
