// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/visits/compare_visits.hpp"

namespace hyperex::visits {

/// The first line of the table.
inline constexpr const char* kTableHeader =
    "visit,measure,side,unit,value,value_low,value_high,change,change_low,change_high,"
    "change_low_measured,change_high_measured,beyond,largest_error,recordings,doubtful";
/// How the first line of every table begins, also of those without the newer columns.
inline constexpr const char* kTableBegins = "visit,measure,side,unit,value,";

/// Writes CSV, one row per visit and measure: the value with its 95 % interval by measurement, and
/// the change since the first visit with its interval, with repetition and by measurement alone.
/// `doubtful`: "yes" where that change is_doubtful(), else "no"; empty without a change. Cells are
/// empty where nothing is known. Throws InputError where the file cannot be written.
void write_visits_table(const std::filesystem::path& file, const Comparison& comparison);

}  // namespace hyperex::visits
