// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// A decoded picture, or one line that says why there is none. A truncated file gives no picture,
/// although many decoders would return its first rows with grey rows below.
struct Decoded {
  cv::Mat picture;    ///< empty if there is a fault
  std::string fault;  ///< begins with the file's name; empty if there is no fault
};

/// Decodes a JPEG or a PNG of any kind to CV_8UC3 in BGR order. Transparency is dropped and 16 bits
/// are reduced to 8. An orientation stored in the file is not applied. `name` is used in the fault.
Decoded decode_colour(std::span<const unsigned char> bytes, const std::string& name);

/// The same for a file. It is a fault if the file is missing, damaged, or not of the size
/// `expected`.
Decoded decode_colour(const std::filesystem::path& file, const Intrinsics& expected);

/// Decodes a 16-bit PNG with one channel to CV_32FC1 in metres: value / depth_per_metre, 0 = no
/// reading. It is a fault if the file is missing, damaged, of another kind or size, or without any
/// reading.
Decoded decode_depth(const std::filesystem::path& file, const Intrinsics& expected,
                     double depth_per_metre);

}  // namespace hyperex::capture
