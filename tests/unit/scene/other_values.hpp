// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// For tests over all keys of the table: a value other than the default for each, and a scene with
// it.
#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {

/// A value other than the default, as JSON. For these values JSON is valid TOML too, except for
/// tables.
inline nlohmann::json other_value(const Key& key) {
  const nlohmann::json standard = key.get(Scene{});
  switch (key.kind) {
    case Kind::flag:
      return !default_of(key).get<bool>();
    case Kind::integer:
      return standard.get<int>() + 1;
    case Kind::number: {
      const double low = key.range.least, high = key.range.most;
      // Written with few digits, as by a user: 15 of them survive conversion.
      const auto within = [&](double share) {
        return std::strtod(fmt::format("{:.12g}", low + (high - low) * share).c_str(), nullptr);
      };
      return standard == within(0.5) ? within(0.25) : within(0.5);
    }
    case Kind::numbers:
      if (key.most == 2) return {key.range.least, key.range.most};
      return {key.range.least, key.range.least + 0.125, key.range.most};
    case Kind::text:
      return "other \"text\" \u00e4";
    case Kind::choice:
      for (const auto& word : key.choices)
        if (word != standard) return word;
      return standard;  // a choice with only one word
    case Kind::path:
      return "face.ply";
    case Kind::names:
      if (key.name == "muscles.without") return {"risorius", "platysma"};
      return {"one", "two", "three"};
    case Kind::places:
      return {{1.5, 2, 3}};
    case Kind::factors:
      return {{key.choices.front(), (key.range.least + key.range.most) / 2}};
    case Kind::rows:
      break;
  }
  if (key.name == "tissue.layer")
    return {{{"name", "skin"}, {"thickness_mm", 1.75}, {"young_factor", 2.5}}};
  if (key.name == "tissue.region") return {{{"name", "nose"}, {"young_factor", 2.5}}};
  if (key.name == "tissue.point")
    return {{{"landmark", "cheek"}, {"side", "R"}, {"young_kpa", 12.5}}};
  nlohmann::json row;
  for (const KeyInfo& column : key.columns)
    if (column.kind == Kind::choice)
      row[column.name] = column.choices.back();
    else if (column.kind == Kind::numbers)
      row[column.name] = {column.range.least, 0.125, column.range.most};
    else if (column.kind == Kind::number)
      row[column.name] = (column.range.least + 3 * column.range.most) / 4;
    else
      row[column.name] = column.kind == Kind::path ? "face.ply" : "chin";
  return nlohmann::json::array({row});
}

inline std::string toml(const nlohmann::json& value) {
  if (value.is_object()) {
    std::string text;
    for (const auto& [name, item] : value.items())
      text += (text.empty() ? "" : ", ") + name + " = " + toml(item);
    return "{" + text + "}";
  }
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const auto& item : value) text += (text.empty() ? "" : ", ") + toml(item);
  return "[" + text + "]";
}

/// A scene file with `key` = `value`, and otherwise only what is required.
inline std::string scene_with(const std::string& key, const std::string& value) {
  std::string text = key + " = " + value + "\n";
  if (key != "scan.file") text += "scan.file = \"embedded\"\n";
  if (key != "motion.file" && key != "motion.recording" && key != "motion.openface" &&
      key != "motion.arkit")
    text += "motion.file = \"embedded\"\n";
  if (key == "solver.newmark_gamma") text += "solver.newmark_beta = 0.5\n";  // at least gamma / 2
  if (key.starts_with("muscles.")) text += "drive.by = \"muscles\"\n";       // otherwise refused
  if (key == "scan.file") text += "scan.landmarks = \"points.json\"\n";
  return text;
}

}  // namespace hyperex::scene
