// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/core/describe.hpp"

namespace hyperex::face {

enum class SkinTone { light, medium, dark };
constexpr auto words_of(SkinTone) {
  return std::array{Word{"light", SkinTone::light}, Word{"medium", SkinTone::medium},
                    Word{"dark", SkinTone::dark}};
}

/// A square picture: sRGB, three bytes a pixel, rows from the top.
struct SkinPicture {
  int size_px = 0;
  std::vector<std::uint8_t> rgb;

  /// Bilinear interpolation at a place, 0 to 1 across and down; clamped at the border.
  std::array<std::uint8_t, 3> at(double u, double v) const;
};

enum class SkinDetail {
  full,
  /// Without lashes and single hairs. For colours of vertices, whose spacing is too large for them,
  /// and for scans whose lids are not exactly at the landmarks.
  soft
};

/// The skin of the canonical face as a picture for its texture coordinates (CanonicalFace::uv):
/// tone, flushed cheeks and nose, lips, brows, lids. Only for display; no figure depends on it.
/// Painted once for each tone and detail and then cached: 0.3 s in full detail, 0.02 s in soft.
const SkinPicture& painted_skin(SkinTone tone, SkinDetail detail = SkinDetail::full);

/// The tone alone: sRGB.
std::array<std::uint8_t, 3> tone_colour(SkinTone tone);

}  // namespace hyperex::face
