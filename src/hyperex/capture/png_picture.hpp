// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

namespace hyperex::capture {

enum class PngAs {
  bgr,         ///< CV_8UC3, whatever is stored
  stored_grey  ///< CV_16UC1 as stored; of any other kind as with `bgr`
};

struct PngPicture {
  cv::Mat picture;    ///< empty where `fault` is not
  std::string fault;  ///< libpng's words: cut short, a check sum that does not fit
};

bool is_png(std::span<const unsigned char> bytes);
/// As its header says; 0 x 0 where it is torn.
cv::Size png_size(std::span<const unsigned char> bytes);
/// The whole file is read to its end and every check sum in it held to, so a torn one is a fault.
/// So is one of more than `most_pixels`.
PngPicture read_png(std::span<const unsigned char> bytes, PngAs as, double most_pixels);

/// The file of a CV_16UC1 picture, kept as it is. std::runtime_error where libpng fails.
std::string png_of_grey(const cv::Mat& picture);

}  // namespace hyperex::capture
