// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::simulate {

/// How far a motion opens the mouth, at the sample at which it is widest open. Four landmarks at
/// the mouth (ibug68_48, 51, 54, 57) are interpolated from the driven points and the still places
/// (still_places) by radial basis functions, so that any set of driven points will do.
struct MouthOpening {
  double opening_m = 0;  ///< increase of the distance between the lips' midpoints
  double corners_m = 0;  ///< increase of the distance between the mouth's corners
  double eyes_m = 0;     ///< distance between the outer corners of the eyes, for scale
};

/// `driven`: names of points; those that `motion` lacks are left out. `gain`: factor on all
/// displacements. Needs the 68 landmarks.
MouthOpening mouth_opening(const AlignedMotion& motion, const std::vector<std::string>& driven,
                           const io::Landmarks& landmarks, double gain = 1);

/// Whether the jaw drops wide without any muscle of the mouth: the mouth opens by more than
/// kWideOpening and its corners part by less than kCornersPart, both over the distance of the eyes.
/// A falling jaw draws the corners together, and muscles draw them apart. Such a motion is
/// simulated as well by displacement as by muscles (docs/muscles.md), in half of the time.
inline constexpr double kWideOpening = 0.2, kCornersPart = 0.004;
bool jaw_drops_alone(const MouthOpening& mouth);

}  // namespace hyperex::simulate
