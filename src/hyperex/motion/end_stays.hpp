// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::motion {

// Readings at a wrong place at the start or the end of a recording. There a point can be seen to
// jump, but not to jump back.

struct EndStay {
  Eigen::Index point = 0;            ///< its row
  std::vector<std::size_t> samples;  ///< of its first or last readings, which are away, rising
  std::size_t jump = 0;              ///< the later of the two samples between which it jumps
  double step_m = 0, speed_m_s = 0;  ///< of that jump
  double lasts_s = 0;                ///< from its outermost reading to the nearest one not away
};

struct EndRule {
  double least_m = 0;         ///< the jump is longer
  double longest_step_s = 0;  ///< the readings of the jump are at most this far apart
  double longest_s = 0;       ///< EndStay::lasts_s is at most this for more than one reading
};

/// The stays at both ends of the paths of points, in the order of the points; the start of each
/// comes first. In each
/// - the jump is more than three times as long as the three steps before it, seen from the middle
///   of the recording, and any step after it,
/// - it is eight times as long as the point usually bends its path,
/// - all readings that are away are more than half of it from the last one that is not,
/// - none of the four points beside it makes a third of it,
/// - the point was not within half of it of there in 0.6 s on that side of the jump.
/// Eyelids really move that fast and are passed over. `names`: one per point. `at`: without the
/// shift of the head (m); what is missing (NaN) is passed over.
///
/// Measured: the recordings that brief_stays.hpp names were cut to 6, 9, 15 and 40 samples, from
/// every sample on, at their own rate, 15 and 6 Hz, with and without noise of 0.3 mm. Above 8 mm
/// (in slower recordings 20 mm, a single reading) nothing is found.
std::vector<EndStay> end_stays(const std::vector<Points>& at, const std::vector<double>& time_s,
                               const std::vector<std::string>& names, const EndRule& rule);

}  // namespace hyperex::motion
