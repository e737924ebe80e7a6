// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/capture/source.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/tracking/fit/face_tracker.hpp"

namespace hyperex::tracking {

/// Called for each finished frame, in order, with its picture (BGR; empty if the source had none).
using FrameVisitor = std::function<void(const TrackedFrame&, const cv::Mat& bgr)>;

/// Frames of the same camera that show the face at rest: those with times in [from_s, to_s],
/// relative to the first frame of the source. The shape at rest is estimated from them before
/// tracking begins.
struct RestFrames {
  capture::FrameSource* source = nullptr;  ///< null: the first tracked frames are used
  double from_s = 0, to_s = 0;
};

/// Tracks a source to its end and shows a progress bar. If `visit` is given, the pictures of
/// buffered frames (FaceTracker) are kept in memory until these frames are finished. Throws
/// InputError if no frame shows a face, or no frame at rest does.
Tracking track(capture::FrameSource& source, const expression::FaceModel& model,
               const TrackerOptions& options = {}, const FrameVisitor& visit = {},
               const RestFrames& rest = {});

/// The same error with the name of the recording: where the text begins with "tracking: ", as that
/// of errors of the trackers does, `recording` (a file, a folder or a device) takes that place. Any
/// other error is returned unchanged.
InputError about_recording(const InputError& error, const std::string& recording);

}  // namespace hyperex::tracking
