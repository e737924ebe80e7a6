// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>

#include "hyperex/capture/intrinsics.hpp"

namespace hyperex::capture {

/// One moment of a recording or a camera.
struct Frame {
  std::size_t index = 0;  ///< in the source, from 0; dropped frames of a live source leave gaps
  double time_s = 0;  ///< by the source's own clock; increases from each valid frame to the next
  cv::Mat colour;     ///< CV_8UC3, BGR, height_px x width_px; empty where it cannot be read
  cv::Mat depth_m;    ///< CV_32FC1, z in metres, registered to the colour picture and of its size,
                      ///< 0 = no reading; empty = colour only
  bool valid = true;  ///< false: must not be measured, see `fault`; the pictures may be empty
  std::string fault;  ///< one line: why it is not valid; empty if it is valid
  /// When the program received the frame of a live source (set by Buffered). For other sources, the
  /// epoch of the clock.
  std::chrono::steady_clock::time_point arrived = {};
};

}  // namespace hyperex::capture
