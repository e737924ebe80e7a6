// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hyperex::scene {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

Complaints wrong(const Given& given) {
  return {{"", given.value, given.key.expected()}};
}

bool holds(const Bounds& range, const json& value) {
  return value.is_number() && std::isfinite(value.get<double>()) &&
         range.holds(value.get<double>());
}

std::string element(std::size_t i) {
  return "[" + std::to_string(i) + "]";
}

bool is_word(const json& value) {
  return value.is_string() && !value.get_ref<const std::string&>().empty();
}

fs::path resolve(const fs::path& folder, const std::string& path) {
  return (folder / path).lexically_normal();
}

/// Whether a path has control characters: "C:\new\table.ply" in double quotes contains a line break
/// and a tab.
bool holds_escape(const std::string& path) {
  return std::any_of(path.begin(), path.end(),
                     [](char c) { return static_cast<unsigned char>(c) < ' '; });
}

/// Checks that the file (or the folder, where the key allows one) exists.
Complaints check_file(const Given& given) {
  if (!is_word(given.value)) return wrong(given);
  const bool folder_too = given.key.folder_too;
  const fs::path path = resolve(given.folder, given.value.get<std::string>());
  std::error_code error;
  if (!fs::exists(path, error))
    return {{"", given.value,
             fmt::format("an existing {} (there is none at {}){}",
                         folder_too ? "folder or video" : "file", show(path.string()),
                         holds_escape(path.string())
                             ? "; a backslash between double quotes begins an escape: put a path "
                               "of Windows between single quotes"
                             : "")}};
  if (!folder_too && fs::is_directory(path, error))
    return {{"", given.value, fmt::format("a file ({} is a folder)", show(path.string()))}};
  return {};
}

}  // namespace

Complaints set_value(const Given& given, bool& member) {
  if (given.key.kind == Kind::choice) {
    std::size_t place = 0;
    Complaints complaints = check_choice(given, place);
    if (complaints.empty()) member = place == 0;
    return complaints;
  }
  if (!given.value.is_boolean()) return wrong(given);
  member = given.value.get<bool>();
  return {};
}
json get_value(const KeyInfo& key, bool member) {
  if (key.kind == Kind::choice) return key.choices[member ? 0 : 1];
  return member;
}

Complaints set_value(const Given& given, int& member) {
  if (!given.value.is_number_integer() || !holds(given.key.range, given.value)) return wrong(given);
  member = given.value.get<int>();
  return {};
}
json get_value(const KeyInfo&, int member) {
  return member;
}

Complaints set_value(const Given& given, double& member) {
  if (!holds(given.key.range, given.value)) return wrong(given);
  member = given.key.unit.to_si(given.value.get<double>());
  return {};
}
json get_value(const KeyInfo& key, double member) {
  return key.unit.from_si(member);
}

Complaints set_value(const Given& given, std::optional<double>& member) {
  double value = 0;
  Complaints complaints = set_value(given, value);
  if (complaints.empty()) member = value;
  return complaints;
}
json get_value(const KeyInfo& key, const std::optional<double>& member) {
  return member ? get_value(key, *member) : json();
}

Complaints set_value(const Given& given, std::string& member) {
  const bool any = given.key.kind != Kind::choice && given.value.is_string() &&
                   given.value.get_ref<const std::string&>().size() >= given.key.least;
  std::size_t place = 0;
  if (!any && (given.key.kind != Kind::choice || !check_choice(given, place).empty()))
    return wrong(given);
  member = given.value.get<std::string>();
  return {};
}
json get_value(const KeyInfo&, const std::string& member) {
  return member;
}

Complaints set_value(const Given& given, fs::path& member) {
  Complaints complaints = check_file(given);
  if (complaints.empty()) member = resolve(given.folder, given.value.get<std::string>());
  return complaints;
}
json get_value(const KeyInfo&, const fs::path& member) {
  return member.generic_string();
}

Complaints set_value(const Given& given, Source& member) {
  if (given.value == "embedded") {
    member = {true, {}};
    return {};
  }
  Complaints complaints = check_file(given);
  if (complaints.empty()) member = {false, resolve(given.folder, given.value.get<std::string>())};
  return complaints;
}
json get_value(const KeyInfo&, const Source& member) {
  return member.embedded ? std::string("embedded") : member.file.generic_string();
}

/// A list of numbers. They must rise strictly, unless the key takes a fixed count (the components
/// of a vector). Where at most two are allowed, a single number needs no brackets.
Complaints set_value(const Given& given, std::vector<double>& member) {
  const KeyInfo& key = given.key;
  json list = given.value;
  if (key.most == 2 && list.is_number()) list = json::array({list});
  if (!list.is_array() || list.size() < key.least || list.size() > key.most) return wrong(given);
  Complaints complaints;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!holds(key.range, list[i])) {
      const std::string unit = key.unit.name;
      complaints.push_back(
          {element(i), list[i], key.range.expected() + (unit.empty() ? "" : " (" + unit + ")")});
    } else if (key.least != key.most && i > 0 && list[i - 1].is_number() &&
               list[i].get<double>() <= list[i - 1].get<double>()) {
      complaints.push_back({element(i), list[i], "a number above the one before it"});
    }
  if (!complaints.empty()) return complaints;
  member.clear();
  for (const json& item : list) member.push_back(key.unit.to_si(item.get<double>()));
  return {};
}
json get_value(const KeyInfo& key, const std::vector<double>& member) {
  json list = json::array();
  for (const double si : member) list.push_back(key.unit.from_si(si));
  return list;
}

Complaints set_value(const Given& given, std::vector<std::string>& member) {
  const json& list = given.value;
  if (!list.is_array() || (list.size() > 0 && list.size() < given.key.least) ||
      list.size() > given.key.most)
    return wrong(given);
  Complaints complaints;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!is_word(list[i]))
      complaints.push_back({element(i), list[i], "a name in quotes"});
    else if (!seen.insert(list[i].get<std::string>()).second)
      complaints.push_back({element(i), list[i], "each name once"});
  if (complaints.empty()) member = list.get<std::vector<std::string>>();
  return complaints;
}
json get_value(const KeyInfo&, const std::vector<std::string>& member) {
  return member;
}

Complaints set_value(const Given& given, std::vector<Place>& member) {
  const json& list = given.value;
  if (!list.is_array() || list.size() > given.key.most) return wrong(given);
  const auto is_number = [](const json& item) {
    return item.is_number() && std::isfinite(item.get<double>());
  };
  Complaints complaints;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!list[i].is_array() || list[i].size() != 3 ||
        !std::all_of(list[i].begin(), list[i].end(), is_number))
      complaints.push_back({element(i), list[i], "three numbers [x, y, z]"});
  if (!complaints.empty()) return complaints;
  const auto si = [&](const json& item) { return given.key.unit.to_si(item.get<double>()); };
  member.clear();
  for (const json& place : list) member.push_back({si(place[0]), si(place[1]), si(place[2])});
  return {};
}
json get_value(const KeyInfo& key, const std::vector<Place>& member) {
  json list = json::array();
  for (const Place& p : member)
    list.push_back({key.unit.from_si(p[0]), key.unit.from_si(p[1]), key.unit.from_si(p[2])});
  return list;
}

Complaints check_choice(const Given& given, std::size_t& place) {
  const auto& choices = given.key.choices;
  const auto word = std::find_if(choices.begin(), choices.end(),
                                 [&](const std::string& choice) { return given.value == choice; });
  place = std::size_t(word - choices.begin());
  return word == choices.end() ? wrong(given) : Complaints{};
}

std::string expected_gain(const std::string& name, const std::vector<std::string>& names,
                          const muscles::MuscleTable& table) {
  const bool misspelt = muscles::gains_meant(name, table).empty() && !nearest(name, names).empty();
  return misspelt ? one_of_names(name, names) : muscles::gain_expected(name, table);
}

namespace {

/// A hint where a percentage was given instead of a factor: " (0.3 for 30 %)".
std::string of_percent(const Bounds& range, const json& factor) {
  if (!factor.is_number()) return "";
  const double given = factor.get<double>();
  constexpr double least = 10;  // a smaller number need not be a percentage
  return given > range.most && given >= least && given <= 100 && range.holds(given / 100)
             ? fmt::format(" ({:g} for {:g} %)", given / 100, given)
             : "";
}

}  // namespace

Complaints check_factors(const Given& given) {
  // A date is converted to a table with this single name.
  if (!given.value.is_object() || given.value.contains("date or time")) return wrong(given);
  const auto& names = given.key.choices;
  Complaints complaints;
  for (const auto& [name, factor] : given.value.items()) {
    // A name with a side may be one of the user's own muscles; it is checked later with its table.
    const bool of_a_side = name.ends_with("_L") || name.ends_with("_R");
    if (!of_a_side && std::find(names.begin(), names.end(), name) == names.end())
      complaints.push_back({"." + name, factor, expected_gain(name, names)});
    else if (!holds(given.key.range, factor))
      complaints.push_back(
          {"." + name, factor, given.key.range.expected() + of_percent(given.key.range, factor)});
  }
  return complaints;
}

namespace {

/// Checks one table for unknown keys, and for required keys that are missing.
void check_row(const KeyInfo& key, const json& table, const std::string& row,
               Complaints& complaints) {
  std::vector<std::string> known;
  for (const KeyInfo& column : key.columns) known.push_back(column.name);
  for (const auto& [name, item] : table.items()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearest(name, known);
    complaints.push_back(
        {row + "." + name, item,
         near.empty() ? "one of " + in_words(known) : "a known key (did you mean " + near + "?)"});
  }
  for (const KeyInfo& column : key.columns)
    if (column.required && !table.contains(column.name))
      complaints.push_back({row + "." + column.name, nullptr, column.expected() + ", required"});
}

}  // namespace

Complaints check_rows(const Given& given) {
  if (!given.value.is_array()) return wrong(given);
  Complaints complaints;
  if (given.value.size() > given.key.most)
    complaints.push_back({"", given.value, fmt::format("at most {} tables", given.key.most)});
  for (std::size_t i = 0; i < given.value.size(); ++i)
    if (given.value[i].is_object())
      check_row(given.key, given.value[i], element(i), complaints);
    else
      complaints.push_back({element(i), given.value[i], "a table"});
  return complaints;
}

}  // namespace hyperex::scene
