// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

enum class GapFill {
  linear,
  cubic  ///< Hermite; its slopes come from the samples on either side of the gap
};

struct GapOptions {
  double max_gap_s = 0.2;  ///< >= 0; time from the last sample before the gap to the first after it
  GapFill fill = GapFill::linear;
};

/// A run of samples (NaN) of one point that was filled.
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
/// nearest measured position. Throws InputError for a gap longer than `max_gap_s`, naming the
/// point, the start and the length of the first one; for a point that was never measured; and for
/// missing samples, which show as a time step longer than both `max_gap_s` and five times the
/// median step.
FilledMotion fill_gaps(const Motion& motion, const GapOptions& options = {});

}  // namespace hyperex::motion
