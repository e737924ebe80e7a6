// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/error.hpp"
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

/// The refusal of a motion that shares only these names with the scan's landmarks, too few to lay
/// it on the scan: it lists the motion's points, and landmarks that their names mean in plain
/// words.
InputError too_few_common(const motion::Motion& m, const std::vector<std::string>& shared);

}  // namespace hyperex::simulate
