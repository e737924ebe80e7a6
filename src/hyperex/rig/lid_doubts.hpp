// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/report/rig_glb.hpp"

namespace hyperex::rig {

/// Shapes of one eye that probably tear its lids: those of lids, gaze and cheekSquint. The skin
/// within 0.8 of the eye's width of its middle then moves by more than 1.8 times the way of the
/// landmarks there. Or it moves by more than 1.6 times that of the other eye in the mirrored shape,
/// where that eye moves at all and the sides are meant to be alike. Less than 2 mm beyond either
/// does not count. One warning `rig.lid_doubtful` per eye, which names its shapes with their
/// millimetres, the worst first. `sides_alike`: false where muscles are changed, since a weak lid
/// is no measure of the other.
/// `skin`: vertices at rest, m, those of the displacements. None without the iBUG points of both
/// eyes.
std::vector<Note> lid_doubts(const Points& skin, const io::Landmarks& landmarks,
                             const std::vector<report::RigShape>& shapes, bool sides_alike = true);

}  // namespace hyperex::rig
