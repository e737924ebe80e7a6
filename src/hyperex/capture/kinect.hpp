// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// The first Kinect (Xbox 360 or Windows v1) through libfreenect: 640 x 480 at 30 Hz, colour and
/// depth in whole millimetres, registered to colour by the device's own parameters. Live: wrap it
/// in LatestFrame, as open_source() does. Time is the device's clock (60 MHz), 0 at the first
/// frame; colour and depth are paired where they are at most 20 ms apart. Not mirrored.
/// The device does not report its colour camera's intrinsics: SourceOptions::camera_file, else the
/// nominal 525 pixels (and a note says so).
/// Where the driver offers raw depth alone, the nominal calibration registers it (and a note says
/// so). Throws InputError where there is no Kinect, it cannot be opened, or gives no frame within 5
/// s. A program that loads libfreenect's fakenect library instead replays a recording. Debian's
/// fakenect is one that offers raw depth alone.
std::unique_ptr<FrameSource> open_kinect(const SourceOptions& options = {});

}  // namespace hyperex::capture
