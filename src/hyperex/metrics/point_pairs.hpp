// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// A point and its counterpart on the other side.
struct PointPair {
  std::string name;           ///< "cheilion", "ibug68_48/54" (right/left)
  int left = -1, right = -1;  ///< columns of the motion
};

/// All pairs of points of a motion, in the order of its names: NAME_L and NAME_R, and mirrored
/// iBUG-68 points, named ibug68_K, K or pK. Pairs that are not measured in the first sample are
/// omitted.
std::vector<PointPair> point_pairs(const motion::Motion& motion);

/// The column of a point by its full name; the motion may have a short one ("48"). -1: none.
int column_of(const motion::Motion& motion, const std::string& full);

}  // namespace hyperex::metrics
