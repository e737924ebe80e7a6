// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/held_readings.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

// Readings that are impossible for a face: markers that were exchanged or lost for a moment, or a
// decimal point in the wrong place.

/// A reading of one point that jumps away and comes back.
struct WildSample {
  std::string point;
  std::size_t sample = 0;
  double off_m = 0;  ///< from the median of the readings around it, without the head's motion
};

struct MendedMotion {
  Motion motion;                 ///< wild readings interpolated; at the ends the nearest one held
  std::vector<WildSample> wild;  ///< in the order of time, then of the points
  /// Readings of exactly (0, 0, 0) of a point whose other readings are all at least off_m from
  /// there: some systems write this for a marker that they do not see. In `motion` they are
  /// missing.
  std::vector<WildSample> zeros;
  /// Readings that jump away and back alone in a slow recording, where a face could do so. Kept.
  std::vector<WildSample> lone;
  /// Readings of `motion` that are as far and as fast from the point's reading before, off_m, in
  /// the same order: points that jump away and stay there longer than can be mended. The ways there
  /// and back of brief stays (brief_stays.hpp) that are too long for it are here as well.
  std::vector<WildSample> jumps;
  /// Readings of markers that were lost and are held at one place (held_readings.hpp). Kept.
  std::vector<HeldReadings> held;
  /// Readings at an end of the recording to which the point jumps, where this may be its movement
  /// (end_stays.hpp). Kept. off_m is the jump.
  std::vector<WildSample> ends;
};

/// A jump counts if it exceeds both this length (m) and this speed (m/s). Lips and jaw reach about
/// 0.3 m/s. At 30 Hz both bounds are the same jump.
inline constexpr double kWildJump_m = 0.02, kWildSpeed_m_s = 0.6;

/// A reading is *lone* if its point jumps to it and back, each time three times as far as between
/// the readings around it and eight times as far as the point usually bends its path, while no
/// point beside it does a third of the same. From 24 samples a second on, where no movement of a
/// face is that short, a lone reading is wild above kLoneJump_m. In slower recordings it is named
/// above kWildJump_m.
inline constexpr double kLoneJump_m = 0.006, kSlowStep_s = 1 / 23.5;

/// At an end of the recording no way back is seen. From 24 samples a second on, a lone jump
/// (end_stays.hpp) to readings that last for up to kLongestEnd_s counts there. They are wild above
/// kLoneJump_m and kFastest_m_s, which lips and jaw hardly reach, up to kLongestMendedEnd_s. Else
/// they are named above kNamedEnd_m. In slower recordings one reading is named above kWildJump_m.
/// Measured: the chin of a phone's take, cut where it is fastest, jumps alone by 6.6 mm at 0.20
/// m/s; on another face the lower lip by 6.8 mm, and by 7.8 mm at 24 Hz. Of wrong readings below
/// kFastest_m_s 2 % are found at 7 mm and 45 % at 8 mm. No bound on how far the points beside it
/// move parts these from real ones.
inline constexpr double kNamedEnd_m = 0.008, kFastest_m_s = 0.3;
inline constexpr double kLongestEnd_s = 0.2, kLongestMendedEnd_s = 0.1;

/// Finds wild readings and replaces them by linear interpolation in time. Wild is what is farther
/// than max(kWildJump_m, kWildSpeed_m_s * median step) from the median of the five readings of its
/// point around it, at most two samples in a row. The median of the same difference over all points
/// is subtracted first, so that a jump of the whole head does not count as a jump of a point. Wild
/// is also what is lone and, from 24 samples a second on, what is in a brief stay
/// (brief_stays.hpp) of up to kLongestMended_s, or away at an end. With fewer than three points or
/// five samples nothing is mended, and with fewer than three points no jump is found.
MendedMotion without_wild_samples(const Motion& motion);

/// The largest plausible distance of a point of a face from its first reading, m.
inline constexpr double kFarthest_m = 0.15;
/// The same, relative to the median of all points, in a motion that contains the head's. It is
/// larger because a turning head adds to the distance.
inline constexpr double kFarthestBesideHead_m = 0.25;

/// Throws InputError naming the line, the point, the time and the distance of the first reading
/// farther than kFarthest_m from the point's first reading. `steady`: a motion without head pose.
void check_reach(const Motion& steady);
/// The same before the head's pose is taken out: the median displacement of all points is
/// subtracted, and kFarthestBesideHead_m is the bound.
void check_reach_beside_head(const Motion& motion);

/// "FILE:LINE, point NAME at 0.467 s"; without the line where it is not known.
std::string place_of(const Motion& motion, const std::string& point, std::size_t sample);

}  // namespace hyperex::motion
