// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/tracking/fit/track_live.hpp"

namespace hyperex::cli {

/// Tracks the face in front of a camera. Tracking ends when the camera ends, when `seconds` (if
/// given) have passed, or at Ctrl-C. In each case the frames tracked so far are returned; a second
/// Ctrl-C ends the program. One line on the terminal shows the progress. At the end, some lines
/// report the number of dropped frames and the time per frame.
tracking::Tracking track_live(capture::FrameSource& source, const expression::FaceModel& model,
                              const tracking::TrackerOptions& options,
                              std::optional<double> seconds,
                              const tracking::FrameVisitor& visit = {});

}  // namespace hyperex::cli
