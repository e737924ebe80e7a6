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
  std::map<std::string, int> lines;  ///< of every value: "scan", "scan.file", "drive.points[2]"
};

struct TornToml {
  int line = 0;            ///< 1-based
  std::string why;         ///< one line
  bool backslash = false;  ///< there is one in that line
  bool comma = false;      ///< in that line one stands in a number, "0,3"
};

/// Throws TornToml where `text` is no TOML.
TomlValues parse_toml(const std::string& text);

/// VALUE of KEY=VALUE where it is one TOML value, else nothing.
std::optional<nlohmann::json> parse_toml_value(const std::string& value);

/// The other way: VALUE that parse_toml_value() gives back, on one line.
std::string toml_text(const nlohmann::json& value);

}  // namespace hyperex::scene
