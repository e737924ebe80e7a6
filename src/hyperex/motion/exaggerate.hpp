// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

struct PointGain {
  std::string point;  ///< a name of the motion
  double gain = 1;    ///< of its displacement from the first sample

  static constexpr const char* about = "A gain on one point of a recording.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(point), "A point of the recording.", {.required = true, .least = 1});
    v.option(HX_MEMBER(gain), "Multiplies its displacement.", {.bounds = {0, 5}, .required = true});
  }
};

/// The motion with the displacements of the named points from their place in the first sample
/// multiplied; all other points stay as they were. What lies between points takes its share from
/// whoever interpolates them (simulate/drive/drive), so nothing is spread here. Points not measured
/// stay NaN. Throws InputError for a name that the motion has not, a name given twice, a gain that
/// is negative or not finite, and a point with a gain that is not measured in the first sample.
Motion with_point_gains(const Motion& motion, const std::vector<PointGain>& gains);

/// The same path in `scale` times the time; the first sample's time stays. 2: twice as slow, half
/// the speed. Throws InputError where scale is not above 0 or not finite.
Motion time_scaled(const Motion& motion, double scale);

}  // namespace hyperex::motion
