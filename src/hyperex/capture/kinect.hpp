// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// The first Kinect (Xbox 360 or Windows v1) through libfreenect: 640 x 480 at 30 Hz. Depth is in
/// whole millimetres and registered to colour with the device's own parameters. The source is live:
/// wrap it in LatestFrame, as open_source() does. Times are those of the device's clock (60 MHz), 0
/// at the first frame. Colour and depth are paired if they are at most 20 ms apart. The pictures
/// are not mirrored. The device does not report the intrinsics of its colour camera. They come from
/// SourceOptions::camera_file; without it, the nominal focal length of 525 pixels is used and a
/// note says so. If the driver offers raw depth only, the nominal calibration registers it, and a
/// note says so. Throws InputError if there is no Kinect, if it cannot be opened, or if it gives no
/// frame within 5 s. A program that loads libfreenect's fakenect library instead of libfreenect
/// replays a recording. Debian's fakenect offers raw depth only.
std::unique_ptr<FrameSource> open_kinect(const SourceOptions& options = {});

}  // namespace hyperex::capture
