// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Finds the letters of render::side_marks() in a finished picture.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "hyperex/render/contact_sheet.hpp"

namespace hyperex::test {

/// A letter as contact_sheet() draws it: offsets of its dark pixels and of the light ones around.
struct LetterShape {
  struct At {
    int x, y;
  };
  std::vector<At> dark, light;
};

inline int grey(const render::Image& image, int x, int y) {
  const std::uint8_t* const p = image.pixel(x, y);
  return (p[0] + p[1] + p[2]) / 3;
}

inline LetterShape shape_of(const render::SideMarks& marks) {
  const auto sheet = [](const render::SideMarks& drawn) {
    return render::contact_sheet({.pictures = {{render::Image(120, 90), "", drawn}}, .columns = 1});
  };
  const render::Image with = sheet(marks), bare = sheet({});
  int low_x = with.width, high_x = 0, low_y = with.height, high_y = 0;
  const auto changed = [&](int x, int y) { return grey(with, x, y) != grey(bare, x, y); };
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x)
      if (changed(x, y)) {
        low_x = std::min(low_x, x), high_x = std::max(high_x, x);
        low_y = std::min(low_y, y), high_y = std::max(high_y, y);
      }
  LetterShape shape;
  for (int y = low_y - 1; y <= high_y + 1; ++y)
    for (int x = low_x - 1; x <= high_x + 1; ++x) {
      if (2 * grey(with, x, y) < grey(bare, x, y)) shape.dark.push_back({x - low_x, y - low_y});
      if (!changed(x, y)) shape.light.push_back({x - low_x, y - low_y});
    }
  return shape;
}

/// How many pictures of a sheet have the letter in one of its places.
inline int letters_in(const cv::Mat& sheet, const std::string& letter) {
  std::vector<LetterShape::At> found;
  for (const LetterShape& shape : {shape_of({.at_left = letter}), shape_of({.at_right = letter})}) {
    const auto stands_at = [&](int left, int top) {
      const auto is_dark = [&](const LetterShape::At& at) {
        return sheet.at<std::uint8_t>(top + at.y, left + at.x) < 128;
      };
      return std::all_of(shape.dark.begin(), shape.dark.end(), is_dark) &&
             std::none_of(shape.light.begin(), shape.light.end(), is_dark);
    };
    constexpr int kBorder = 20;
    for (int y = kBorder; y < sheet.rows - kBorder; ++y)
      for (int x = kBorder; x < sheet.cols - kBorder; ++x)
        if (stands_at(x, y) && std::none_of(found.begin(), found.end(), [&](const auto& one) {
              return std::abs(one.x - x) < 8 && std::abs(one.y - y) < 8;
            }))
          found.push_back({x, y});
  }
  return int(found.size());
}

inline cv::Mat grey_picture(const std::filesystem::path& png) {
  return cv::imread(png.string(), cv::IMREAD_GRAYSCALE);
}

}  // namespace hyperex::test
