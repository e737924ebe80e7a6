// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::simulate {

/// Points of a motion that are landmarks of the scan by name, in the motion's order, m.
struct CommonPoints {
  std::vector<std::string> names;
  Points motion;  ///< in the first sample
  Points scan;
};

CommonPoints common_points(const motion::Motion& m, const io::Landmarks& landmarks);

}  // namespace hyperex::simulate
