// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

/// Those that drive.points names, or all. The default points are the canonical face's: where the
/// motion is CANDIDE's and the scene names none, those that it has.
std::vector<std::string> driven_points(const scene::Scene& scene, const motion::Motion& motion);
/// Adds `drive.points_left_out` where default points were left out.
void note_left_out_points(const scene::Scene& scene, const motion::Motion& motion,
                          std::vector<Note>& notes);

}  // namespace hyperex::session
