// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// Points that keep their distances from each other over the whole recording, as points fixed to
/// the skull do: the largest set that grows from one point and in which no distance changes by more
/// than kStillPoints_m, in the motion's order. Points of mouth and jaw (ibug68_4 to 12 and 48 to
/// 67) are left out, since lower lip and chin go together too. Empty where fewer than four are
/// found, or where they lie nearly on a line. At most some 200 samples are looked at.
std::vector<std::string> find_still_points(const Motion& motion);

/// Of a marker that is glued to the skin over bone, and of the noise of its measurement.
inline constexpr double kStillPoints_m = 1e-3;

/// Whether a motion has enough of the usual points of the skull (default_rigid_points) to find the
/// head's pose.
bool has_pose_points(const Motion& motion);

/// The points to name as moving with the skull where has_pose_points() is false:
/// find_still_points().
std::vector<std::string> proposed_rigid_points(const Motion& motion);

}  // namespace hyperex::motion
