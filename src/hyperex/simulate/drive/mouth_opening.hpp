// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::simulate {

/// How far a motion opens the mouth of a face, by any set of points: what the driven points tell of
/// four landmarks at the mouth (ibug68_48, 51, 54, 57), by radial-basis interpolation with the
/// places that are taken to be still (still_places). At the sample at which the mouth is widest
/// open.
struct MouthOpening {
  double opening_m = 0;  ///< what the distance of the lips' midpoints gains
  double corners_m = 0;  ///< what the distance of the mouth's corners gains
  double eyes_m = 0;     ///< between the outer corners of the eyes, the measure of both
};

/// `driven`: names of points of `motion`; those that it lacks are left out. `gain`: on
/// displacements. Needs the 68 landmarks.
MouthOpening mouth_opening(const AlignedMotion& motion, const std::vector<std::string>& driven,
                           const io::Landmarks& landmarks, double gain = 1);

/// Whether the jaw drops wide and no muscle of the mouth takes part: the mouth opens by more than
/// kWideOpening and its corners part by less than kCornersPart, both over the distance of the eyes.
/// A falling jaw draws them together; muscles that smile, speak or stretch draw them apart. Such a
/// motion is as near to the truth by displacement as by muscles (docs/muscles.md), and by
/// displacement it takes half of the time.
inline constexpr double kWideOpening = 0.2, kCornersPart = 0.004;
bool jaw_drops_alone(const MouthOpening& mouth);

}  // namespace hyperex::simulate
