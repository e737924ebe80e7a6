// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"
#include "hyperex/motion/still_points.hpp"

namespace hyperex::session {

/// What the names of a recording's points say about a run, before landmarks are looked for.

/// Throws InputError where too few points can carry the head's pose: what to record, and what works
/// without them. `rigid_points`: motion.rigid_points of a scene.
void check_head_points(const motion::Motion& motion, const std::vector<std::string>& rigid_points);

/// Throws InputError, as aligning does, where fewer than three names are those of landmarks, which
/// are the same on every scan on which a run finds them.
void check_landmark_names(const motion::Motion& motion);

/// What both would say of a recording for which a scene is to be made; `rigid_points`: those that
/// the scene will name.
std::vector<std::string> doubts_of_names(const motion::Motion& motion,
                                         const std::vector<std::string>& rigid_points);

/// The points that a new scene of this recording names in motion.rigid_points
/// (motion::points_to_hold_the_head), its wild readings and its samples without any reading left
/// out.
motion::StillPoints points_to_hold_the_head(const motion::Motion& recorded);

}  // namespace hyperex::session
