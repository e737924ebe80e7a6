// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Plays a recording in real time, like a camera, for tests without one. Each frame is returned
/// when the time since the first frame equals the difference of their time_s. An invalid frame is
/// returned at once. live() is true: wrap the source in LatestFrame, as open_source() does.
std::unique_ptr<FrameSource> play(std::unique_ptr<FrameSource> recording);

}  // namespace hyperex::capture
