// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

namespace hyperex::capture {

enum class PngAs {
  bgr,         ///< CV_8UC3, whatever is stored
  stored_grey  ///< CV_16UC1 if 16-bit grey is stored; anything else as with `bgr`
};

struct PngPicture {
  cv::Mat picture;    ///< empty if there is a fault
  std::string fault;  ///< libpng's message, such as a truncated file or a wrong check sum
};

bool is_png(std::span<const unsigned char> bytes);
/// The size that the header states; 0 x 0 if the header is damaged.
cv::Size png_size(std::span<const unsigned char> bytes);
/// Reads the whole file and verifies every check sum, so that a truncated or damaged file is a
/// fault. A picture of more than `most_pixels` is a fault too.
PngPicture read_png(std::span<const unsigned char> bytes, PngAs as, double most_pixels);

/// A CV_16UC1 picture as the bytes of a PNG file, without loss. Throws std::runtime_error if libpng
/// fails.
std::string png_of_grey(const cv::Mat& picture);

}  // namespace hyperex::capture
