// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

/// Those that drive.points names. "all": every point but those of motion.rigid_points and
/// `stomion`, which lies between the lips. Where the scene names none: seven of the mouth (of
/// CANDIDE's motion those that it has), and of brows and lids each part with a point that goes
/// 2 mm from its first place, of the nostrils 3 mm. `motion`: head pose out.
std::vector<std::string> driven_points(const scene::Scene& scene, const motion::Motion& motion);
/// Adds `drive.points_left_out` where default points were left out, `drive.parts_joined` and
/// `drive.measured_not_driven` where the default points follow the motion.
void note_left_out_points(const scene::Scene& scene, const motion::Motion& motion,
                          std::vector<Note>& notes);

}  // namespace hyperex::session
