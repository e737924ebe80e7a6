// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hyperex/core/files.hpp"
#include "hyperex/io/text_table.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/scene/variant_names.hpp"
#include "hyperex/study/axes.hpp"
#include "hyperex/study/contact_of_cases.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {
using nlohmann::json;

constexpr const char* kCaseColumn = "case";

StudyText read_text(const fs::path& file) {
  std::error_code error;
  const auto fail = [&](int line, const std::string& expected) -> InputError {
    return InputError(InputProblem{file, line, "", "", expected});
  };
  if (!fs::exists(file, error)) throw fail(0, "an existing study file");
  if (fs::is_directory(file, error)) throw fail(0, "a study file; this is a folder");
  try {
    scene::TomlValues values = scene::parse_toml(read_file(file));
    return {file, std::move(values.root), std::move(values.lines)};
  } catch (const scene::TornToml& torn) {
    throw fail(torn.line, "sound TOML (" + torn.why + ")");
  }
}

void refuse_unknown_names(StudyText& text) {
  const std::vector<std::string> known = {"title", "scene", "out", "set", "grid", "cases"};
  for (const auto& [name, value] : text.root.items()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = scene::nearest(name, known);
    const bool of_a_scene = scene::find_key(name) || value.is_object();
    text.complain(name, value.is_object() ? json() : value,
                  "one of " + fmt::format("{}", fmt::join(known, ", ")) +
                      (!near.empty() ? "; did you mean " + near + "?"
                       : of_a_scene  ? "; keys of the scene belong under [set] or [grid]"
                                     : ""));
  }
}

/// A path in the study file; empty where it is not given.
fs::path path_at(StudyText& text, const std::string& name, const std::string& expected) {
  const json value = text.root.value(name, json());
  if (value.is_null()) return {};
  if (value.is_string() && !value.get_ref<const std::string&>().empty())
    return (text.file.parent_path() / value.get<std::string>()).lexically_normal();
  text.complain(name, value, expected);
  return {};
}

fs::path scene_of(StudyText& text) {
  const std::string expected = "the path of a scene file";
  const fs::path scene = path_at(text, "scene", expected);
  std::error_code error;
  if (!text.root.contains("scene"))
    text.complain("scene", nullptr, expected + ", required");
  else if (!scene.empty() && !fs::is_regular_file(scene, error))
    text.complain("scene", text.root["scene"], "an existing scene file");
  return scene;
}

std::vector<scene::Override> overrides_of_all(StudyText& text) {
  std::vector<scene::Override> overrides;
  const json set = text.root.value("set", json::object());
  if (!set.is_object()) {
    text.complain("set", set, "a table, [set], of keys and values");
    return overrides;
  }
  for (const auto& [key, value] : scene::changes_of(set))
    overrides.push_back(text.override_of(key, value, "set." + key));
  return overrides;
}

Step step_of_row(const io::TextTable& table, std::size_t row, const fs::path& folder,
                 std::string& name) {
  Step step;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    const std::string& key = table.names[c];
    const std::string& cell = table.rows[row][c];
    if (key == kCaseColumn) {
      name = cell;
      continue;
    }
    step.cells.emplace_back(key, cell);
    if (cell.empty()) continue;  // the scene's value applies
    step.overrides.push_back({key + "=" + cell, {table.file, table.lines[row]}, folder});
  }
  return step;
}

/// An axis whose steps are the rows of the CSV; no axis where there is no CSV.
std::vector<Axis> axis_of_rows(StudyText& text) {
  const fs::path file = path_at(text, "cases", "the path of a CSV file with a case a row");
  if (file.empty()) return {};
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    text.complain("cases", text.root["cases"], "an existing CSV file");
    return {};
  }
  const io::TextTable table = io::read_text_table(file);
  const bool named = std::count(table.names.begin(), table.names.end(), kCaseColumn) > 0;
  for (const std::string& key : table.names)
    if (key != kCaseColumn && !scene::find_key(key))
      text.problems.push_back(
          {file, 1, "column " + scene::show(key), "", scene::unknown_key(key) + ", or \"case\""});
  if (table.rows.empty()) text.problems.push_back({file, 0, "", "", "one or more rows"});
  Axis axis{kCaseColumn, 0, {}, {}};
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::string name = fmt::format("row {}", row + 1);
    Step step = step_of_row(table, row, text.file.parent_path(), name);
    if (named && !scene::is_variant_name(name))
      text.problems.push_back({file, table.lines[row], kCaseColumn, scene::show(name),
                               "a name of letters, digits, spaces and any of "
                               "-_.,;:+=%&'()[], at most 100"});
    step.label = name;
    axis.steps.push_back(std::move(step));
  }
  return {std::move(axis)};
}

void refuse_equal_names(StudyText& text, const std::vector<Case>& cases) {
  std::set<std::string> names;
  for (const Case& one : cases)
    if (!names.insert(one.name).second)
      text.problems.push_back({one.origin.file, one.origin.line, "case", scene::show(one.name),
                               "a name that no other case has"});
}

/// Returns false and adds a problem where there are too many cases.
bool is_countable(StudyText& text, const std::vector<Axis>& axes) {
  double count = 1;
  for (const Axis& axis : axes) count *= double(axis.steps.size());
  if (count > double(kMostCases))
    text.complain("grid", nullptr,
                  fmt::format("at most {} cases; its axes make {:.0f}", kMostCases, count));
  return count <= double(kMostCases);
}

std::vector<Case> cases_of(StudyText& text, const std::vector<Axis>& axes,
                           const std::vector<scene::Override>& of_all) {
  std::vector<Case> cases;
  constexpr std::size_t longest = 100;
  for (Step& step : combined(axes)) {
    std::string name = step.label;
    if (name.size() > longest) name = fmt::format("case {}", cases.size() + 1);
    scene::Origin origin{text.file, 0};
    if (!step.overrides.empty() && step.overrides.front().origin.file != text.file)
      origin = step.overrides.front().origin;  // the row of the CSV
    step.overrides.insert(step.overrides.begin(), of_all.begin(), of_all.end());
    cases.push_back({name, std::move(step.overrides), std::move(step.cells), origin});
  }
  return cases;
}

fs::path folder_of(StudyText& text) {
  const fs::path given = path_at(text, "out", "the name of a folder for the cases");
  if (!given.empty()) return given;
  return text.file.parent_path() / (text.file.stem().string() + "_out");
}

}  // namespace

Study read_study(const fs::path& file) {
  StudyText text = read_text(file);
  refuse_unknown_names(text);
  Study study;
  study.file = text.file;
  study.scene = scene_of(text);
  study.out = folder_of(text);
  if (const json title = text.root.value("title", json("")); !title.is_string())
    text.complain("title", title, "a text in quotes");
  const std::vector<scene::Override> of_all = overrides_of_all(text);
  std::vector<Axis> axes = axis_of_rows(text);
  for (Axis& axis : read_axes(text)) axes.push_back(std::move(axis));
  if (axes.empty() && text.problems.empty())
    text.complain("grid", nullptr,
                  "a key with a list of values, or cases = \"FILE.csv\", required");
  if (text.problems.empty() && is_countable(text, axes)) {
    study.cases = cases_of(text, axes, of_all);
    refuse_equal_names(text, study.cases);
  }
  if (!text.problems.empty()) {
    std::stable_sort(text.problems.begin(), text.problems.end(),
                     [](const auto& a, const auto& b) { return a.line < b.line; });
    throw InputError(text.problems);
  }
  settle_contact(study);
  return study;
}

}  // namespace hyperex::study
