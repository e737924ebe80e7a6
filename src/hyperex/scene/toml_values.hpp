// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hyperex::scene {

/// A TOML text as JSON values. Dates and times become {"date or time": text}.
struct TomlValues {
  nlohmann::json root;               ///< an object
  std::map<std::string, int> lines;  ///< line of each value: "scan", "scan.file", "drive.points[2]"
};

struct TornToml {
  int line = 0;            ///< 1-based
  std::string why;         ///< on one line
  bool backslash = false;  ///< whether that line contains a backslash
  bool comma = false;      ///< whether a number in that line has a decimal comma: "0,3"
};

/// Throws TornToml where `text` is not TOML.
TomlValues parse_toml(const std::string& text);

/// VALUE of KEY=VALUE where it is one TOML value, else nothing.
std::optional<nlohmann::json> parse_toml_value(const std::string& value);

/// The same of a list or table that is written as JSON, as {"side_R": 0.3}.
std::optional<nlohmann::json> parse_json_value(const std::string& value);

/// The inverse of parse_toml_value(): a VALUE on one line, from which parse_toml_value() gives
/// `value`.
std::string toml_text(const nlohmann::json& value);

}  // namespace hyperex::scene
