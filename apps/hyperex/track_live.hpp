// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/tracking/fit/track_live.hpp"

namespace hyperex::cli {

/// Follows the face before a camera until the camera ends, `seconds` (where given) are over or the
/// user ends it with Ctrl-C: what was tracked until then is then given, and a second Ctrl-C ends
/// the program. One line on the terminal shows the progress, and some at the end what was dropped
/// and how long frames took.
tracking::Tracking track_live(capture::FrameSource& source, const expression::FaceModel& model,
                              const tracking::TrackerOptions& options,
                              std::optional<double> seconds,
                              const tracking::FrameVisitor& visit = {});

}  // namespace hyperex::cli
