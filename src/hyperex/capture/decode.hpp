// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// A picture, or one line that says why there is none. A torn file gives no picture, although
/// decoders would hand out its first rows above grey ones.
struct Decoded {
  cv::Mat picture;    ///< empty where `fault` is not
  std::string fault;  ///< names the file
};

/// CV_8UC3, BGR, as stored (an orientation noted in the file is not applied), from a JPEG or a PNG
/// of any kind (transparency is dropped, 16 bits become 8). `name` is for the fault.
Decoded decode_colour(std::span<const unsigned char> bytes, const std::string& name);

/// The same from a file. A fault where it is missing, torn, or not of the size `expected`.
Decoded decode_colour(const std::filesystem::path& file, const Intrinsics& expected);

/// CV_32FC1 in metres from a 16-bit PNG of one channel: value / depth_per_metre, 0 = no reading.
/// A fault where it is missing, torn, of other kind or size, or has no reading at all.
Decoded decode_depth(const std::filesystem::path& file, const Intrinsics& expected,
                     double depth_per_metre);

}  // namespace hyperex::capture
