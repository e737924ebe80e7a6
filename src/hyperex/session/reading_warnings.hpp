// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/wild_samples.hpp"

namespace hyperex::session {

/// Where the readings of a recording's points come from.
enum class Readings {
  /// Each point was measured by itself, so that a wild reading of it is replaced.
  measured,
  /// Weights of expressions move all points of a face model. Replacing single points would distort
  /// the face, so that wild readings are only reported, as jumps.
  of_weights
};

/// Of readings of a recording that no face makes, in this order:
/// * `recording.wild_samples`: those that were left out, because no face moves like that,
/// * `recording.zeros`: those of (0, 0, 0), which were taken as missing,
/// * `recording.lone_samples`: those of a slow recording that jump away and back alone,
/// * `recording.jumps`: those to which a point moves as no face does, and which were kept,
/// * `recording.held_points`: those of points that are held while others move, which were kept,
/// * `recording.end_samples`: those away at an end of the recording, which may be real; kept.
/// Each names the first three, and says how many more there are.
std::vector<Note> reading_warnings(const motion::MendedMotion& mended);

/// `recording.far_points`: points that go farther from their first place than this part of a face
/// can. `steady`: without head pose, in the size of a person (m). Of weights, it names the rig or
/// face model whose shapes carry the points so far, since no reading of a point can be corrected.
std::optional<Note> far_points_warning(const motion::Motion& steady,
                                       Readings readings = Readings::measured);

}  // namespace hyperex::session
