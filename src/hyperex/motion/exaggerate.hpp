// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

struct PointGain {
  std::string point;  ///< name of a point of the motion
  double gain = 1;    ///< factor on its displacement from the first sample

  static constexpr const char* about = "A gain on one point of a recording.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(point), "A point of the recording.", {.required = true, .least = 1});
    v.option(HX_MEMBER(gain), "Multiplies its displacement.", {.bounds = {0, 5}, .required = true});
  }
};

/// The motion, with the displacement of each named point from its position in the first sample
/// multiplied by the point's gain. All other points stay as they were. The skin between the points
/// follows later, by interpolation (simulate/drive/drive). Points not measured stay NaN. Throws
/// InputError for a name that is not in the motion, a name given twice, a gain that is negative or
/// not finite, and a point with a gain that is not measured in the first sample.
Motion with_point_gains(const Motion& motion, const std::vector<PointGain>& gains);

/// The same path in `scale` times the time; the time of the first sample does not change. With
/// scale = 2 the motion takes twice as long, at half the speed. Throws InputError where `scale` is
/// not finite or not above 0.
Motion time_scaled(const Motion& motion, double scale);

}  // namespace hyperex::motion
