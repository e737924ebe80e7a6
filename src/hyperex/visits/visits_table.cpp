// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/visits_table.hpp"

#include <fmt/format.h>

#include <string>

#include "hyperex/core/files.hpp"
#include "hyperex/io/csv_cells.hpp"
#include "hyperex/visits/summary.hpp"

namespace hyperex::visits {
namespace {

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "";
}

std::string both(const std::optional<Interval>& interval) {
  return interval ? cell(interval->low) + "," + cell(interval->high) : ",";
}

std::string row(const Comparison& comparison, const MeasureOverVisits& one, std::size_t visit) {
  const std::string& label = comparison.file.visits[visit].label;
  const VisitValue& value = *one.values[visit];
  std::string text =
      fmt::format("{},{},{},{},{},{},", io::in_quotes_where_needed(label), one.measure.key,
                  one.measure.side, one.measure.unit, cell(value.value), both(value.measured));
  if (const auto& change = one.changes[visit])
    text += fmt::format("{},{},{},{},{},", cell(change->value), both(change->all),
                        both(change->measured), words_of(change->beyond), change->largest);
  else
    text += ",,,,,,,";
  const bool doubtful = is_doubtful(comparison, one, visit);
  return text + fmt::format("{},{}\n", value.recordings,
                            !one.changes[visit] ? ""
                            : doubtful          ? "yes"
                                                : "no");
}

}  // namespace

void write_visits_table(const std::filesystem::path& file, const Comparison& comparison) {
  write_file_atomically(file, [&](std::ostream& stream) {
    stream << kTableHeader << '\n';
    for (std::size_t v = 0; v < comparison.file.visits.size(); ++v)
      for (const MeasureOverVisits& one : comparison.measures)
        if (one.values[v]) stream << row(comparison, one, v);
  });
}

}  // namespace hyperex::visits
