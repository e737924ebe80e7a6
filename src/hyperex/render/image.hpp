// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "hyperex/render/colour.hpp"

namespace hyperex::render {

/// Opaque picture, sRGB with 8 bits a channel, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 width height

  Image() = default;
  Image(int width_px, int height_px, const Colour& fill = palette::background);
  std::uint8_t* pixel(int x, int y) { return rgb.data() + 3 * (std::size_t(y) * width + x); }
  const std::uint8_t* pixel(int x, int y) const {
    return rgb.data() + 3 * (std::size_t(y) * width + x);
  }
};

/// Writes a PNG. The file appears complete or not at all. Throws InputError where it cannot be
/// written.
void write_png(const std::filesystem::path& file, const Image& image);

/// The PNG's bytes, to be embedded in a page.
std::vector<std::uint8_t> png_bytes(const Image& image);

}  // namespace hyperex::render
