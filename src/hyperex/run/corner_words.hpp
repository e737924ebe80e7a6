// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sentences for the terminal on the corners of the mouth, from a run's summary. The pages follow
// the same rules (web/src/replay/corners.ts). The right side comes first, because it is on the left
// when one looks at a face.
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/metrics/excursion.hpp"

namespace hyperex::run {

/// One line: "corners of the mouth: right 12.7 mm, left 3.8 mm, a difference of 8.9 mm: more than
/// the floor of 0.1 mm (mesh)"; empty if the corners are not known. Where the recording's jitter is
/// not known, the line says so instead of letting the difference pass for decided. Where the
/// summary has an error budget, its interval stands in place of the floor: "a difference of 8.9 mm
/// (95 %: +- 0.8; mostly jitter)".
std::string corners_line(const nlohmann::ordered_json& summary);
/// What a sentence on figures ends with where a warning before it doubts them.
inline constexpr const char* kDoubtfulEnding = "; doubtful, see the warning above";

/// The same of a recording that was not simulated. `doubtful`: whether a warning before the line
/// doubts its figures (session::doubts_figures). Then it ends with kDoubtfulEnding.
std::string corners_line(const metrics::Excursions& excursions, bool doubtful = false);

/// One line: that results are in millimetres of the scan, and how the recording's compare. Empty
/// where both have one size (`recording.rescaled` of the notes).
std::string rescaled_line(const nlohmann::ordered_json& summary);

/// The effect of each variant on the corners of the mouth, one line per variant: "  weak right:
/// corner of the mouth right 9.6 to 6.2 mm, moves 3.4 mm less (+- 0.3); left 10.1 mm, unchanged".
/// Compared are greatest distances from rest, as in variants_excursions.csv, with their band. The
/// last lines say that these are the ones to quote. What they hide has a line of its own:
///   * of a corner that turns aside, its component in the unchanged direction, that of its
///     displacement in base, with the band of that change: "right corner: in the unchanged
///     direction 9.6 to 4.1 mm, 5.5 mm less (+- 0.4)";
///   * a larger effect at another time: "left corner: at 3.63 s it is 6.6 mm from where it is
///     without the change";
///   * why a corner still moves where a variant lets no muscle of its side pull.
/// Where the summary has an error budget, its interval stands in place of the band,
/// "(95 %: +- 2.9)", and the change in the unchanged direction has none.
std::string variant_lines(const nlohmann::ordered_json& summary);

}  // namespace hyperex::run
