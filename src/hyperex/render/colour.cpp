// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyperex::render {

Colour moss(double share) {
  static constexpr std::array<int, 11> tenths = {0xe4e2d3, 0xd2d1ac, 0xbcc286, 0xa3b466,
                                                 0x86a64f, 0x6a9743, 0x4f873f, 0x37773d,
                                                 0x206639, 0x095535, 0x00442e};
  const double position = 10 * std::clamp(std::isnan(share) ? 0.0 : share, 0.0, 1.0);
  const int low = std::min(9, static_cast<int>(position));
  const double t = position - low;
  const auto channel = [&](int shift) {
    const double from = tenths[low] >> shift & 0xff, to = tenths[low + 1] >> shift & 0xff;
    return ((1 - t) * from + t * to) / 255;
  };
  return {channel(16), channel(8), channel(0)};
}

double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace hyperex::render
