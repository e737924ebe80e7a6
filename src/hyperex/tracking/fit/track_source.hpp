// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "hyperex/capture/source.hpp"
#include "hyperex/tracking/fit/face_tracker.hpp"

namespace hyperex::tracking {

/// Told of each frame once it is finished, in order, with its picture (BGR; empty where the source
/// had none).
using FrameVisitor = std::function<void(const TrackedFrame&, const cv::Mat& bgr)>;

/// Frames of the same camera that show the face at rest, with times in [from_s, to_s] from the
/// source's first frame: what is at rest is learnt from them before tracking begins.
struct RestFrames {
  capture::FrameSource* source = nullptr;  ///< none: the first frames that are tracked
  double from_s = 0, to_s = 0;
};

/// Tracks a source to its end, with a progress bar. With `visit` the pictures of frames that are
/// held back (FaceTracker) are kept in memory until they are finished. Throws InputError where no
/// frame, or none of those at rest, shows a face.
Tracking track(capture::FrameSource& source, const expression::FaceModel& model,
               const TrackerOptions& options = {}, const FrameVisitor& visit = {},
               const RestFrames& rest = {});

}  // namespace hyperex::tracking
