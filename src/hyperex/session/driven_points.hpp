// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

/// Whether the scene names no points that drive.
bool drives_by_default(const scene::Scene& scene);
/// The points that drive: those that drive.points names. "all": every point but those of
/// motion.rigid_points and `stomion`, which lies between the lips. Where the scene names none:
/// seven of the mouth (with CANDIDE's motion those that it has), and each part of brows and lids
/// with a point that moves by 2 mm from its first place, of the nostrils by 3 mm. `motion`: without
/// head pose.
std::vector<std::string> driven_points(const scene::Scene& scene, const motion::Motion& motion);
/// Adds `drive.points_left_out` where default points were left out, `drive.parts_joined` and
/// `drive.measured_not_driven` (the outline of the face, and other points that move by 2 mm until
/// time.end_s) where the default points follow the motion.
void note_left_out_points(const scene::Scene& scene, const motion::Motion& motion,
                          std::vector<Note>& notes);

}  // namespace hyperex::session
