// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::session {

/// Where the readings of a recording's points come from.
enum class Readings {
  /// Each point was measured by itself, so that a wild reading of it is replaced.
  measured,
  /// Weights of expressions move all points of a face model. Replacing single points would distort
  /// the face, so that wild readings are only reported, as jumps.
  of_weights
};

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
std::optional<Note> check_steady(const motion::Motion& steady);

}  // namespace hyperex::session
