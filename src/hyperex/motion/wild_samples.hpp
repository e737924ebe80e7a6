// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

// Single readings that no face can make: markers that were exchanged or lost for a moment, or a
// decimal point in the wrong place.

/// A reading of one point that jumps away and comes back.
struct WildSample {
  std::string point;
  std::size_t sample = 0;
  double off_m = 0;  ///< from the median of the readings around it, the head's motion left out
};

struct MendedMotion {
  Motion motion;                 ///< wild readings are interpolated, held at the ends
  std::vector<WildSample> wild;  ///< in the order of time, then of the points
};

/// The least jump that counts, m, and the least speed of it, m/s. Lips and jaw reach some 0.3 m/s;
/// at 30 Hz both bounds are the same jump.
inline constexpr double kWildJump_m = 0.02, kWildSpeed_m_s = 0.6;

/// Interpolates, linearly in time, each reading farther than max(kWildJump_m, kWildSpeed_m_s *
/// median step) from the median of the five readings of its point around it, after the median over
/// all points of the same difference has been taken off: a jump of the whole head is none of a
/// point. So at most two samples in a row are mended. Needs three points and five samples; of fewer
/// nothing is mended.
MendedMotion without_wild_samples(const Motion& motion);

/// No point of a face goes farther from its place in the first sample, m.
inline constexpr double kFarthest_m = 0.15;

/// Throws InputError naming the line, the point, the time and the distance of the first reading
/// farther than kFarthest_m from the point's place in the first sample. `steady`: head pose out.
void check_reach(const Motion& steady);

/// "FILE:LINE, point NAME at 0.467 s"; without the line where it is not known.
std::string place_of(const Motion& motion, const std::string& point, std::size_t sample);

}  // namespace hyperex::motion
