// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// A recording that comes at its own pace, like a camera: each frame is given when as much time has
/// gone by since the first as its time_s says (a frame that is not valid comes at once). live() is
/// true: wrap it in LatestFrame, as open_source() does. A rehearsal without a camera.
std::unique_ptr<FrameSource> play(std::unique_ptr<FrameSource> recording);

}  // namespace hyperex::capture
