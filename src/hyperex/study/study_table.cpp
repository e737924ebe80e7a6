// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/study_table.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "hyperex/core/files.hpp"
#include "hyperex/io/text_table.hpp"
#include "hyperex/study/study_folder.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {
using Json = nlohmann::ordered_json;
using Measures = std::vector<std::pair<std::string, std::string>>;

/// The first columns.
const std::vector<std::string> kFirst = {"symmetry.commissure.excursion_mm.L",
                                         "symmetry.commissure.excursion_mm.R",
                                         "symmetry.commissure.difference_mm",
                                         "symmetry.commissure.floor_mm",
                                         "symmetry.commissure.undecided",
                                         "symmetry.S_most",
                                         "max_displacement_mm",
                                         "lip_opening_mm",
                                         "seconds.total"};

/// The measures of each pair of points. More would make the table unreadable; excursions.csv has
/// them all.
const std::vector<std::string> kOfAPair = {"excursion_mm", "difference_mm", "floor_mm",
                                           "undecided"};

/// Entries that are not measures, or are distributions.
bool is_left_out(const std::string& name) {
  return name == "options" || name == "mesh_quality.least_dihedral_share" ||
         name == "symmetry.commissure.point" || name == "symmetry.commissure.recorded";
}

std::string number(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  return value.dump();
}

void add(const std::string& name, const Json& value, Measures& measures);

void add_members(const std::string& name, const Json& object, Measures& measures) {
  for (const auto& [key, item] : object.items())
    add(name.empty() ? key : name + "." + key, item, measures);
}

/// Adds a list of tables, each under its own name.
void add_named(const std::string& name, const Json& list, const char* name_key,
               Measures& measures) {
  for (const Json& item : list) {
    if (!item.is_object() || !item.contains(name_key) || !item[name_key].is_string()) continue;
    const std::string below = name + "." + item[name_key].get<std::string>();
    for (const auto& [key, value] : item.items())
      if (name_key != std::string("point") ||
          std::find(kOfAPair.begin(), kOfAPair.end(), key) != kOfAPair.end())
        add(below + "." + key, value, measures);
  }
}

void add(const std::string& name, const Json& value, Measures& measures) {
  if (is_left_out(name)) return;
  if (value.is_object())
    add_members(name, value, measures);
  else if (name == "symmetry.excursions")
    add_named(name, value, "point", measures);
  else if (name == "variants.table")
    add_named("variants", value, "name", measures);
  else if (value.is_number() || value.is_boolean() || value.is_null())
    measures.emplace_back(name, number(value));
}

/// Lets one process at a time write the table. The last one then includes the results of all before
/// it.
class TableLock {
 public:
  explicit TableLock(const fs::path& folder)
      : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ >= 0) ::flock(file_, LOCK_EX);
  }
  ~TableLock() {
    if (file_ >= 0) ::close(file_);
  }
  TableLock(const TableLock&) = delete;
  TableLock& operator=(const TableLock&) = delete;

 private:
  int file_;
};

/// Columns in the order of their first appearance, and the cells of each row by column.
struct Rows {
  std::vector<std::string> names;
  std::map<std::string, std::size_t> place;
  std::vector<std::map<std::size_t, std::string>> cells;

  void put(const std::string& name, const std::string& cell) {
    const auto [at, is_new] = place.emplace(name, names.size());
    if (is_new) names.push_back(name);
    cells.back()[at->second] = cell;
  }
  std::vector<std::vector<std::string>> filled() const {
    std::vector<std::vector<std::string>> all;
    for (const auto& row : cells) {
      all.emplace_back(names.size());
      for (const auto& [column, cell] : row) all.back()[column] = cell;
    }
    return all;
  }
};

Json summary_in(const fs::path& folder) {
  const Json summary = Json::parse(read_file(folder / "summary.json"), nullptr, false);
  return summary.is_object() ? summary : Json::object();
}

/// "cases/NAME-HASH": relative to the study's folder.
std::string folder_in_study(const CaseFiles& files) {
  return (files.folder.parent_path().filename() / files.folder.filename()).generic_string();
}

}  // namespace

Measures measures_in(const Json& summary) {
  Measures all;
  for (const auto& [key, value] : summary.items())
    if (key != "warnings") add(key, value, all);
  if (const auto warnings = summary.find("warnings"); warnings != summary.end())
    all.emplace_back("warnings", std::to_string(warnings->size()));
  Measures sorted;
  for (const std::string& name : kFirst)
    for (const auto& measure : all)
      if (measure.first == name) sorted.push_back(measure);
  for (const auto& measure : all)
    if (std::find(kFirst.begin(), kFirst.end(), measure.first) == kFirst.end())
      sorted.push_back(measure);
  return sorted;
}

std::vector<State> write_table(const Study& study, const std::vector<PlannedCase>& planned) {
  const TableLock lock(study.out / "logs");
  std::vector<State> states;
  Rows rows;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    states.push_back(state_of(planned[i].files));
    rows.cells.emplace_back();
    rows.put("case", study.cases[i].name);
    rows.put("state", to_string(states[i]));
    for (const auto& [name, cell] : study.cases[i].cells) rows.put(name, cell);
  }
  const Rows first = rows;  // the measures come after the changed keys of all cases
  rows.cells.clear();
  for (std::size_t i = 0; i < planned.size(); ++i) {
    rows.cells.push_back(first.cells[i]);
    if (states[i] != State::finished) continue;
    for (const auto& [name, cell] : measures_in(summary_in(planned[i].files.folder)))
      rows.put(name, cell);
  }
  for (std::size_t i = 0; i < planned.size(); ++i) {
    std::swap(rows.cells[i], rows.cells.back());
    rows.put("message", states[i] == State::failed ? failure_of(planned[i].files.log) : "");
    rows.put("hash", planned[i].hash);
    rows.put("folder", folder_in_study(planned[i].files));
    std::swap(rows.cells[i], rows.cells.back());
  }
  io::write_text_table(table_of(study.out), rows.names, rows.filled());
  return states;
}

}  // namespace hyperex::study
