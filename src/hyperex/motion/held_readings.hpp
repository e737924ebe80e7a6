// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

// Readings of a marker that the system lost and holds at its last place.

/// Equal readings of a point, one after the other.
struct HeldReadings {
  std::string point;
  std::size_t first = 0, last = 0;  ///< samples, both included
};

/// The shortest time (s) from the first to the last of the equal readings, and the fewest of them.
inline constexpr double kLeastHeld_s = 0.2;
inline constexpr std::size_t kLeastHeld = 5;

/// The points that are held, in the order of the points, then of time. A point is held if
/// - its readings are equal to the last digit for at least kLeastHeld_s and kLeastHeld samples, and
///   it has other readings,
/// - three of the four points beside it go at least 1 mm, and five of the file's smallest steps,
///   away from where they are at the first of these readings,
/// - points of this recording hardly ever repeat a reading (below 1 % of the steps of the median
///   point), or the point jumps when it is released: by as far as the others have to go, and three
///   times as far as in the steps just before and after.
/// The last condition keeps points that are exactly still where others move, as in recordings that
/// a program made without noise.
///
/// Measured: nothing is found in the recordings at hand, nor where they are rounded to 0.01, 0.1 or
/// 1 mm. These are 41 markers at 60 Hz, smiles and talks, and a rig's 68, 23, 11 and 10 points in
/// 4,030 samples of a phone's weights and in each expression alone, of one side and of both. Of
/// markers that were held at random for 0.2 to 1 s, such that they were off by more than 2 mm, 98 %
/// are found.
std::vector<HeldReadings> held_readings(const Motion& motion);

}  // namespace hyperex::motion
