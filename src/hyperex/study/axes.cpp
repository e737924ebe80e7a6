// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/axes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/scene/variant_names.hpp"

namespace hyperex::study {
namespace {
using nlohmann::json;

constexpr const char* kName =
    "a name of letters, digits, spaces and any of -_.,;:+=%&'()[], at most 100, a letter or digit "
    "among them";

/// "tissue.young_kpa" -> "young_kpa".
std::string short_key(const std::string& key) {
  return key.substr(key.find('.') + 1);
}

/// The part of a case's name that distinguishes step number `index` from the others.
std::string label_of(const std::string& key, const json& value, std::size_t index) {
  const scene::Key* known = scene::find_key(key);
  std::string word = value.is_structured() ? "" : cell_of(value);
  if (known && known->kind == scene::Kind::path) word = std::filesystem::path(word).stem().string();
  constexpr std::size_t longest = 30;
  if (word.empty() || word.size() > longest) word = fmt::format("no. {}", index + 1);
  return short_key(key) + "=" + word;
}

Axis axis_of_key(StudyText& text, const std::string& key, const json& values) {
  const std::string place = "grid." + key;
  Axis axis{key, text.line_of(place), {}, {key}};
  if (!scene::find_key(key)) {
    text.complain(place, nullptr, scene::unknown_key(key));
  } else if (!values.is_array() || values.empty()) {
    text.complain(place, values, "a list of one or more values of " + key);
  } else {
    for (std::size_t i = 0; i < values.size(); ++i)
      axis.steps.push_back({label_of(key, values[i], i),
                            {text.override_of(key, values[i], fmt::format("{}[{}]", place, i))},
                            {{key, cell_of(values[i])}}});
  }
  return axis;
}

/// A table of a named axis: its name, and keys with values.
Step step_of_table(StudyText& text, Axis& axis, const json& table, const std::string& place) {
  const json name = table.value("name", json());
  if (!name.is_string() || !scene::is_variant_name(name.get<std::string>()))
    text.complain(place + ".name", name, kName);
  Step step{cell_of(name), {}, {{axis.name, cell_of(name)}}};
  for (const Step& other : axis.steps)
    if (other.label == step.label)
      text.complain(place + ".name", name, "a name that no other table of the axis has");
  for (const auto& [key, value] : scene::changes_of(table)) {
    step.overrides.push_back(text.override_of(key, value, place + "." + key));
    step.cells.emplace_back(key, cell_of(value));
    if (std::find(axis.keys.begin(), axis.keys.end(), key) == axis.keys.end())
      axis.keys.push_back(key);
  }
  return step;
}

Axis axis_of_tables(StudyText& text, const std::string& name, const json& tables) {
  Axis axis{name, text.line_of("grid." + name), {}, {}};
  if (!scene::is_variant_name(name)) text.complain("grid." + name, nullptr, kName);
  for (std::size_t i = 0; i < tables.size(); ++i)
    axis.steps.push_back(step_of_table(text, axis, tables[i], fmt::format("grid.{}[{}]", name, i)));
  return axis;
}

bool are_tables(const json& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const json& item) { return item.is_object(); });
}

}  // namespace

int StudyText::line_of(const std::string& name) const {
  const auto found = lines.find(name);
  if (found != lines.end()) return found->second;
  const auto dot = name.rfind('.');  // a missing key has no line: take that of its table
  return dot == std::string::npos ? 0 : line_of(name.substr(0, dot));
}

void StudyText::complain(const std::string& name, const json& value, const std::string& expected) {
  problems.push_back(
      {file, line_of(name), name, value.is_null() ? "" : scene::show(value), expected});
}

scene::Override StudyText::override_of(const std::string& key, const json& value,
                                       const std::string& name) {
  if (!scene::find_key(key)) complain(name, value, scene::unknown_key(key));
  return {key + "=" + scene::toml_text(value), {file, line_of(name)}, file.parent_path()};
}

std::string cell_of(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_null() ? "" : scene::toml_text(value);
}

std::vector<Axis> read_axes(StudyText& text) {
  std::vector<Axis> axes;
  const json grid = text.root.value("grid", json());
  if (grid.is_null()) return axes;
  if (!grid.is_object()) {
    text.complain("grid", grid, "a table, [grid], of keys with lists of values");
    return axes;
  }
  for (const auto& [name, value] : grid.items()) {
    if (value.is_object())
      for (const auto& [key, values] : value.items())
        axes.push_back(axis_of_key(text, name + "." + key, values));
    else if (are_tables(value))
      axes.push_back(axis_of_tables(text, name, value));
    else
      axes.push_back(axis_of_key(text, name, value));
  }
  std::stable_sort(axes.begin(), axes.end(),
                   [](const Axis& a, const Axis& b) { return a.line < b.line; });
  std::map<std::string, std::string> owner;
  for (const Axis& axis : axes)
    for (const std::string& key : axis.keys)
      if (const auto [at, is_new] = owner.emplace(key, axis.name); !is_new)
        text.complain("grid." + axis.name, nullptr,
                      fmt::format("keys that no other axis sets, and {} sets {}", at->second, key));
  return axes;
}

std::vector<Step> combined(const std::vector<Axis>& axes) {
  std::vector<Step> all = {Step{}};
  for (const Axis& axis : axes) {
    std::vector<Step> longer;
    for (const Step& before : all)
      for (const Step& step : axis.steps) {
        Step both = before;
        both.label += (both.label.empty() ? "" : " ") + step.label;
        both.overrides.insert(both.overrides.end(), step.overrides.begin(), step.overrides.end());
        both.cells.insert(both.cells.end(), step.cells.begin(), step.cells.end());
        longer.push_back(std::move(both));
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace hyperex::study
