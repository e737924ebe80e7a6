// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/session/reading_warnings.hpp"

namespace hyperex::session {

// Checks of a recording by itself, by an average face, where no scan shows the person's own.

/// Throws InputError where left and right are exchanged (check_sides, check_pairs). Returns
/// sides_warning, exchanged_warning, size_warning, `recording.point_off` and timing_warning, in
/// this order. `recording.point_off`: points that misplaced_points() finds by the average face and
/// that lie 15 mm or more from their places there, as where two names are exchanged. `m` may
/// contain the head's motion and gaps: the first of its samples with the most measured points is
/// judged.
std::vector<Note> check_alone(const motion::Motion& m, Readings readings = Readings::measured);

/// `recording.size_implausible`: the points with known names lie less than 0.5 or more than 1.8
/// times as far apart as on an average face, as root mean square distance from their mean; in the
/// same sample. Where the size is that of another unit, the warning names it.
std::optional<Note> size_warning(const motion::Motion& m);

/// `recording.point_off` as check_alone() finds it.
std::optional<Note> point_off_warning(const motion::Motion& m);

/// Whether the very figures of a recording may be wrong where this warning stands: points seem to
/// be others than their names say, or lengths others than they are, the recording seems to start
/// or to end in an expression (extent_warnings), or nothing moves (stillness_warning).
bool doubts_figures(const Note& warning);

/// How the recording's unit was guessed, "cm (guessed: ...)"; empty where the file or its user
/// states it.
std::string guessed_unit(const motion::Motion& m);

}  // namespace hyperex::session
