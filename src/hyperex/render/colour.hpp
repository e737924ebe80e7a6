// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>

namespace hyperex::render {

/// sRGB, each 0 to 1.
struct Colour {
  double r = 0, g = 0, b = 0;
  bool operator==(const Colour&) const = default;
};

/// The interval that a colour map spans; values outside get the colour of the nearer end. low <
/// high.
struct Range {
  double low = 0, high = 1;
};

/// From pale to dark green in even steps of lightness (OKLCH 0.91 to 0.34, hue 100 to 165 degrees;
/// B. Ottosson 2020), readable without colour vision. Small values are light, since dark colours
/// hide the features of a face. The report's map "moss" (web/src/replay/face/colour.ts) has the
/// same values. `share` is clamped to 0..1.
Colour moss(double share);

/// Where `value` lies in `range`, 0 to 1, clamped.
inline double share_in(const Range& range, double value) {
  return std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
}

double linear_from_srgb(double value);  ///< IEC 61966-2-1, one channel, 0 to 1
double srgb_from_linear(double value);

namespace palette {
inline constexpr Colour background{0.953, 0.953, 0.957};
inline constexpr Colour ink{0.16, 0.17, 0.19};
inline constexpr Colour faint_ink{0.45, 0.46, 0.49};
inline constexpr Colour skin{0.80, 0.765, 0.735};
inline constexpr Colour driven{0.84, 0.19, 0.15};  ///< points that a motion drives
inline constexpr Colour held{0.12, 0.36, 0.66};    ///< points that do not move
inline constexpr Colour cut{0.95, 0.62, 0.05};     ///< where a surface was cut
}  // namespace palette

}  // namespace hyperex::render
