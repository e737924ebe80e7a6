// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/study/plan_cases.hpp"

namespace hyperex::study {

/// The beginning of every table, by which it is recognised.
constexpr const char* kTableBegins = "case,state,";

/// The measures in a run's summary. A name is the path in the summary, joined by '.', and includes
/// the unit: {"symmetry.commissure.excursion_mm.L", "3.8"}. True and false are 1 and 0; an unknown
/// value is empty. The most important measures come first, then the others in the summary's order.
/// For pairs of points only the excursions are included; for variants only their table.
std::vector<std::pair<std::string, std::string>> measures_in(const nlohmann::ordered_json& summary);

/// Writes OUT/study.csv. Each case has one row: its name and state, the changed keys, the measures
/// if it has finished, the reason if it failed, its hash and its folder. Waits while another
/// process writes the table. Returns the states.
std::vector<State> write_table(const Study& study, const std::vector<PlannedCase>& planned);

}  // namespace hyperex::study
