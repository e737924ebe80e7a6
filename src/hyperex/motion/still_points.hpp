// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// Points that keep their distances from each other over the whole recording, as points fixed to
/// the skull do. A set is grown from each point in turn, such that no distance in it changes by
/// more than kStillPoints_m; the largest set is returned, in the motion's order. Points of the
/// mouth and the jaw (ibug68_4 to 12 and 48 to 67) are left out, since the lower lip and the chin
/// also move together. Empty where fewer than four points are found, or where they lie nearly on a
/// line. Of a long recording 200 to 400 evenly spaced samples are used.
std::vector<std::string> find_still_points(const Motion& motion);

/// Allows for the motion of a marker glued to the skin over bone, and for measurement noise.
inline constexpr double kStillPoints_m = 1e-3;

/// Whether a motion has enough of the usual points of the skull (default_rigid_points) to estimate
/// the head pose.
bool has_pose_points(const Motion& motion);

/// The points to name as moving with the skull where has_pose_points() is false:
/// find_still_points().
std::vector<std::string> proposed_rigid_points(const Motion& motion);

}  // namespace hyperex::motion
