// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::session {

/// `recording.nothing_moves`: no point moves 0.05 mm from its first place, without head pose. So it
/// is where the recording has jitter (recorded_jitter) and nothing moves beyond it: with all tracks
/// smoothed by a low-pass of 3 Hz, no point goes farther from its first place than jitter takes the
/// farthest of all points in all but about 1 of 100 recordings. The jitter of a point is its own,
/// at least that of all. A smoothed point that goes 3 mm or more always counts as moving. The first
/// rule holds alone in fewer than 20 samples, where they are more than 0.1 s apart, and where
/// `eyes_turn`: the recording has the gaze, and the eyes turn in it.
std::optional<Note> stillness_warning(const motion::Motion& stabilised, bool eyes_turn);

}  // namespace hyperex::session
