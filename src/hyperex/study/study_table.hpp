// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/study/plan_cases.hpp"

namespace hyperex::study {

/// How every table begins, and no other file by chance.
constexpr const char* kTableBegins = "case,state,";

/// The measures in a run's summary, named by where they stand with '.' between, the unit with it:
/// {"symmetry.commissure.excursion_mm.L", "3.8"}; true and false as 1 and 0, what is unknown empty.
/// First the most wanted columns, then the rest in the summary's order. Of pairs of points those of
/// excursions, of variants their table.
std::vector<std::pair<std::string, std::string>> measures_in(const nlohmann::ordered_json& summary);

/// Writes OUT/study.csv: one row per case with its name and state, changed keys and measures as far
/// as it is finished, why it failed, its hash and its folder. Waits for another process that writes
/// it. Returns the states.
std::vector<State> write_table(const Study& study, const std::vector<PlannedCase>& planned);

}  // namespace hyperex::study
