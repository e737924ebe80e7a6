// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/visits/compare_visits.hpp"

namespace hyperex::visits {

/// What changed between the first and the last visit, in sentences: for each side the measure that
/// the expression is judged by. "Right corner of the mouth: 8.0 mm on 2026-06-01, 12.1 mm on
/// 2026-03-01; 4.1 mm less (95 %: 2.3 to 5.9), beyond what measurement and repetition make." Where
/// the interval holds no change, both of its bounds have a word: "(95 %: 1.8 less to 1.6 more)".
/// With one visit, its values alone. A corner of the mouth that moves 2 mm or more at both visits
/// ends with ", but its direction has changed (upward 3.9 to -3.9 mm)" where a part of its way is
/// reversed, or its angle turned, beyond the interval. A side whose points a visit lacks is "not
/// recorded". Visits whose faces have different scales are not compared. A change that is beyond
/// comes first, the largest of them before the others; else R is before L. Where there are
/// doubts(), each comparison ends with "doubtful", and a sentence for each of them follows. A
/// last sentence has the norm of healthy adults, if there is one.
std::vector<std::string> summary(const Comparison& comparison);

/// Where the figure for repetition comes from.
std::string repetition_sentence(const Comparison& comparison);

/// Why the figures of the first or of the last visit, which summary() compares, may be wrong; each
/// once.
std::vector<std::string> doubts(const Comparison& comparison);

/// Whether the change of a visit from the first is doubtful: a recording of either has doubts.
/// Measures of scans do not come from a recording, and are not.
bool is_doubtful(const Comparison& comparison, const MeasureOverVisits& one, std::size_t visit);

/// Whether a change is beyond, as words_of(), with ", doubtful" where is_doubtful(): "yes,
/// doubtful". For visits with a change.
std::string verdict_words(const Comparison& comparison, const MeasureOverVisits& one,
                          std::size_t visit);

/// The remarks on the order of visits and on all recordings, and the doubts of the visits between
/// the first and the last; each once.
std::vector<std::string> remarks(const Comparison& comparison);

/// What was chosen where the file leaves it open, as the points that hold the head; each once.
std::vector<std::string> choices(const Comparison& comparison);

}  // namespace hyperex::visits
