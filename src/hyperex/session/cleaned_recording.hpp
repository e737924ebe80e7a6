// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/session/reading_warnings.hpp"

namespace hyperex::session {

/// A recording that can be evaluated, and what was found in its single readings.
struct CleanedRecording {
  motion::Motion motion;       ///< as motion::without_wild_samples leaves it
  std::vector<Note> warnings;  ///< reading_warnings(), in that order
};

/// Removes wild readings of a motion that contains the head's, and checks the others, before one
/// that is far off spoils the head's pose. Throws InputError where a point is implausibly far from
/// its first place (motion::check_reach_beside_head).
CleanedRecording cleaned_recording(const motion::Motion& recorded,
                                   Readings readings = Readings::measured);

/// The same check once the head's pose is taken out: the warning of points that go too far, if
/// any (far_points_warning). `steady`: without head pose, in the size of a person (m). Throws
/// InputError where a point is implausibly far from its first place (motion::check_reach).
std::optional<Note> check_steady(const motion::Motion& steady,
                                 Readings readings = Readings::measured);

}  // namespace hyperex::session
