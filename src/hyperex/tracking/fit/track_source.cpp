// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/track_source.hpp"

#include <deque>
#include <optional>
#include <string_view>

#include "hyperex/core/progress.hpp"

namespace hyperex::tracking {
namespace {

/// Estimates the person's shape and skin from the frames at rest. Their tracking results are
/// discarded.
void learn_rest(FaceTracker& tracker, const RestFrames& rest) {
  Progress progress("looking at the face at rest", 0);
  std::optional<double> start_s;
  while (const auto frame = rest.source->next()) {
    if (!start_s) start_s = frame->time_s;
    const double at_s = frame->time_s - *start_s;
    if (at_s > rest.to_s) break;
    if (at_s >= rest.from_s) tracker.feed(*frame);
  }
  tracker.finish();
  if (!tracker.neutral())
    throw InputError("tracking", "no face was found in the frames that show it at rest");
}

}  // namespace

Tracking track(capture::FrameSource& source, const expression::FaceModel& model,
               const TrackerOptions& options, const FrameVisitor& visit, const RestFrames& rest) {
  FaceTracker tracker(model, source.intrinsics(), options);
  if (rest.source != nullptr) learn_rest(tracker, rest);
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

InputError about_recording(const InputError& error, const std::string& recording) {
  constexpr std::string_view nameless = "tracking: ";
  const std::string said = error.what();
  if (!said.starts_with(nameless)) return error;
  return {recording, said.substr(nameless.size())};
}

}  // namespace hyperex::tracking
