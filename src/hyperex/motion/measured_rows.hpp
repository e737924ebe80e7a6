// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// The samples in which all points `rows` are measured, rising.
std::vector<std::size_t> samples_with_all(const Motion& motion, const std::vector<int>& rows);

/// The time from the last reading of a point before its longest gap to the first one after it (s);
/// at an end of the motion, to or from that end. 0 without gaps; infinite without any reading.
double longest_gap_s(const Motion& motion, int row);

/// Those of `rows` whose gaps are none longer than `most_s`, less those with the most lost readings
/// until at least half of the samples, and two, have all the others. Rows without a gap stay.
std::vector<int> hardly_interrupted(const Motion& motion, const std::vector<int>& rows,
                                    double most_s);

/// Whether the points `rows` give a pose in every sample that lacks one of them: three that are
/// measured there and in the first sample, and do not lie nearly on a line (spread_off_line() of
/// at least `least_spread`).
bool give_pose_in_gaps(const Motion& motion, const std::vector<int>& rows, double least_spread);

}  // namespace hyperex::motion
