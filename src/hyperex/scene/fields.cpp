// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "hyperex/io/number.hpp"

namespace hyperex::scene {
namespace fs = std::filesystem;
using nlohmann::json;

bool Range::holds(double value) const {
  if (!std::isfinite(value)) return false;
  if (or_zero && value == 0) return true;
  return (above_low ? value > low : value >= low) && value <= high;
}

std::string Range::text() const {
  return fmt::format("{}{}{:g} to {:g}", or_zero ? "0, or " : "", above_low ? "above " : "", low,
                     high);
}

double Unit::from_si(double si) const {
  const double value = si * over / times;
  // std::stod throws for the least numbers that there are.
  return io::parse_number(fmt::format("{:.15g}", value)).value_or(value);
}

namespace {
std::string words(const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i)
    text += (i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ") + ('"' + choices[i] + '"');
  return text;
}

std::string number_text(const KeyInfo& info, const char* one) {
  std::string text = fmt::format(
      "{} {}{}", one, info.range.above_low || info.range.or_zero ? "" : "from ", info.range.text());
  return info.unit.empty() ? text : text + " (" + info.unit + ")";
}

std::string count_text(std::size_t least, std::size_t most) {
  if (least == 0) return "";
  if (most >= 1000) return fmt::format("{} or more ", least);
  return fmt::format("{} to {} ", least, most);
}

bool is_word(const json& value) {
  return value.is_string() && !value.get_ref<const std::string&>().empty();
}
}  // namespace

std::string KeyInfo::expected() const {
  switch (kind) {
    case Kind::flag:
      return "true or false";
    case Kind::integer:
      return number_text(*this, "an integer");
    case Kind::number:
      return number_text(*this, "a number");
    case Kind::numbers:
      if (most == 2) return number_text(*this, "a number, or a list of two rising ones, each");
      return "a list of " + count_text(least, most) + number_text(*this, "rising numbers, each");
    case Kind::text:
      return least > 0 ? "a name in quotes" : "a text in quotes";
    case Kind::choice:
      return words(choices);
    case Kind::path:
      return "the path of a file" + (choices.empty() ? "" : ", or " + words(choices));
    case Kind::names:
      return (least > 0 ? fmt::format("a list of no names, or {} or more different ones", least)
                        : "a list of different names") +
             (choices.empty() ? "" : ", or " + words(choices));
    case Kind::places:
      return "a list of places [x, y, z]" + (unit.empty() ? "" : " (" + unit + ")");
    case Kind::factors:
      return fmt::format("a table of names and numbers from {}, as in {{ {} = 0.5 }}", range.text(),
                         choices.empty() ? "name" : choices.front());
    case Kind::rows:
      break;
  }
  return "[[" + name + "]] tables";
}

std::vector<Complaint> check_number(const KeyInfo& info, const json& value) {
  const bool right_type =
      info.kind == Kind::integer ? value.is_number_integer() : value.is_number();
  if (right_type && info.range.holds(value.get<double>())) return {};
  return {{"", value, info.expected()}};
}

std::vector<Complaint> check_numbers(const KeyInfo& info, const json& value) {
  if (!value.is_array() || value.size() < info.least || value.size() > info.most)
    return {{"", value, info.expected()}};
  std::vector<Complaint> complaints;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string below = "[" + std::to_string(i) + "]";
    if (!value[i].is_number() || !info.range.holds(value[i].get<double>()))
      complaints.push_back({below, value[i], number_text(info, "a number")});
    else if (i > 0 && value[i - 1].is_number() &&
             value[i].get<double>() <= value[i - 1].get<double>())
      complaints.push_back({below, value[i], "a number above the one before it"});
  }
  return complaints;
}

std::vector<Complaint> check_names(const KeyInfo& info, const json& value) {
  if (!value.is_array() || (value.size() > 0 && value.size() < info.least) ||
      value.size() > info.most)
    return {{"", value, info.expected()}};
  std::vector<Complaint> complaints;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string below = "[" + std::to_string(i) + "]";
    if (!is_word(value[i]))
      complaints.push_back({below, value[i], "a name in quotes"});
    else if (!seen.insert(value[i].get<std::string>()).second)
      complaints.push_back({below, value[i], "each name once"});
  }
  return complaints;
}

std::vector<Complaint> check_text(const KeyInfo& info, const json& value) {
  if (value.is_string() && value.get_ref<const std::string&>().size() >= info.least) return {};
  return {{"", value, info.expected()}};
}

fs::path resolve(const fs::path& folder, const std::string& path) {
  return (folder / path).lexically_normal();
}

/// "C:\new\table.ply" between double quotes holds a line break and a tab.
bool holds_escape(const std::string& path) {
  return std::any_of(path.begin(), path.end(),
                     [](char c) { return static_cast<unsigned char>(c) < ' '; });
}

std::vector<Complaint> check_file(const KeyInfo& info, const json& value, const fs::path& folder,
                                  bool folder_too) {
  if (!is_word(value)) return {{"", value, info.expected()}};
  const fs::path path = resolve(folder, value.get<std::string>());
  std::error_code error;
  if (!fs::exists(path, error))
    return {{"", value,
             fmt::format("an existing {} (there is none at {}){}",
                         folder_too ? "folder or video" : "file", show(path.string()),
                         holds_escape(path.string())
                             ? "; a backslash between double quotes begins an escape: put a path "
                               "of Windows between single quotes"
                             : "")}};
  if (!folder_too && fs::is_directory(path, error))
    return {{"", value, fmt::format("a file ({} is a folder)", show(path.string()))}};
  return {};
}

std::vector<Complaint> check_places(const KeyInfo& info, const json& value) {
  if (!value.is_array() || value.size() > info.most) return {{"", value, info.expected()}};
  const auto is_number = [](const json& item) {
    return item.is_number() && std::isfinite(item.get<double>());
  };
  std::vector<Complaint> complaints;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (!value[i].is_array() || value[i].size() != 3 ||
        !std::all_of(value[i].begin(), value[i].end(), is_number))
      complaints.push_back({"[" + std::to_string(i) + "]", value[i], "three numbers [x, y, z]"});
  return complaints;
}

std::string one_of_names(const std::string& name, const std::vector<std::string>& names) {
  const std::string near = nearest(name, names);
  return near.empty() ? fmt::format("one of {}", fmt::join(names, ", "))
                      : "another name; did you mean " + near + "?";
}

std::vector<Complaint> check_factors(const KeyInfo& info, const json& value) {
  // A date comes as a table of this one name.
  if (!value.is_object() || value.contains("date or time")) return {{"", value, info.expected()}};
  std::vector<Complaint> complaints;
  for (const auto& [name, factor] : value.items()) {
    // What has a side may be a muscle of the user's own, which is looked at with its table.
    const bool of_a_side = name.ends_with("_L") || name.ends_with("_R");
    if (!of_a_side &&
        std::find(info.choices.begin(), info.choices.end(), name) == info.choices.end()) {
      complaints.push_back({"." + name, factor, one_of_names(name, info.choices)});
    } else if (!factor.is_number() || !info.range.holds(factor.get<double>())) {
      complaints.push_back({"." + name, factor, number_text(info, "a number")});
    }
  }
  return complaints;
}

std::vector<Complaint> check_rows(const KeyInfo& info, const json& value) {
  if (!value.is_array()) return {{"", value, info.expected()}};
  std::vector<std::string> known;
  for (const auto& column : info.columns) known.push_back(column.name);
  std::vector<Complaint> complaints;
  if (value.size() > info.most)
    complaints.push_back({"", value, fmt::format("at most {} tables", info.most)});
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string row = "[" + std::to_string(i) + "]";
    if (!value[i].is_object()) {
      complaints.push_back({row, value[i], "a table"});
      continue;
    }
    for (const auto& [name, item] : value[i].items()) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string near = nearest(name, known);
      complaints.push_back(
          {row + "." + name, item,
           near.empty() ? "one of " + words(known) : "a known key (did you mean " + near + "?)"});
    }
    for (const auto& column : info.columns)
      if (column.required && !value[i].contains(column.name))
        complaints.push_back({row + "." + column.name, nullptr, column.expected() + ", required"});
  }
  return complaints;
}

}  // namespace hyperex::scene
