// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

enum class GapFill {
  linear,
  cubic  ///< Hermite, with the slopes of the samples beside the gap
};

struct GapOptions {
  double max_gap_s = 0.2;  ///< >= 0; from the last sample before to the first after
  GapFill fill = GapFill::linear;
};

/// One stretch of NaN that was filled.
struct FilledGap {
  std::string point;
  double from_s = 0, to_s = 0;  ///< first and last sample that had no value
  int samples = 0;
};

struct FilledMotion {
  Motion motion;                ///< without NaN
  std::vector<FilledGap> gaps;  ///< in the order of the points, then of time
};

/// Fills stretches where a point was not measured. A gap at the start or the end is filled with the
/// nearest measured position. Throws InputError naming point, start and length of the first gap
/// longer than `max_gap_s`, a point that never was measured, or a hole in the samples themselves:
/// a step longer than `max_gap_s` and than five usual (median) steps.
FilledMotion fill_gaps(const Motion& motion, const GapOptions& options = {});

}  // namespace hyperex::motion
