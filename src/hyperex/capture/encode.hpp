// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace hyperex::capture {

/// A JPEG of a picture with three bytes a pixel (sRGB), rows from the top. `quality`: 1 to 100.
/// Throws std::invalid_argument where the bytes are not those of this size.
std::vector<std::uint8_t> jpeg_bytes(std::span<const std::uint8_t> rgb, int width_px, int height_px,
                                     int quality = 88);

}  // namespace hyperex::capture
