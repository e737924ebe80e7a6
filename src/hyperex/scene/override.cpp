// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/toml_values.hpp"

namespace hyperex::scene {
using nlohmann::json;

namespace {

/// "muscles.gain={side_L=...}" for a name in a table of factors, such as "muscle.gain.side_L";
/// empty for all others.
std::string in_table_of_factors(const std::string& name, const std::vector<std::string>& all) {
  const auto last = name.rfind('.');
  if (last == std::string::npos || section_of(name).size() == last) return "";
  const std::string table = name.substr(0, last);
  const Key* key = find_key(find_key(table) ? table : nearest(table, all));
  if (!key || key->kind != Kind::factors) return "";
  return fmt::format("{}={{{}=...}}", key->name, name.substr(last + 1));
}

}  // namespace

std::string unknown_key(const std::string& name) {
  if (const std::string other = in_place_of(name); !other.empty()) return other;
  std::vector<std::string> all;
  std::string siblings;
  for (const Key& key : keys()) {
    all.push_back(key.name);
    if (!section_of(name).empty() && section_of(key.name) == section_of(name))
      siblings += (siblings.empty() ? "" : ", ") + key.name.substr(section_of(name).size() + 1);
  }
  std::string near = in_table_of_factors(name, all);
  if (near.empty()) near = nearest(name, all);
  if (!near.empty()) return "a known key (did you mean " + near + "?)";
  if (!siblings.empty())
    return fmt::format("a known key ([{}] has {})", section_of(name), siblings);
  return "a known key (docs/scene.md lists them)";
}

std::string unknown_section(const std::string& name) {
  std::vector<std::string> all;
  std::string list;
  for (const Section& section : sections()) {
    if (section.name.empty()) continue;
    all.push_back(section.name);
    list += (list.empty() ? "" : ", ") + section.name;
  }
  const std::string near = nearest(name, all);
  return near.empty() ? "a known section (" + list + ")"
                      : "a known section (did you mean [" + near + "]?)";
}

bool is_section(const std::string& name) {
  const auto& all = sections();
  return !name.empty() &&
         std::any_of(all.begin(), all.end(), [&](const Section& s) { return s.name == name; });
}

json override_value(const std::string& key, const std::string& text) {
  std::optional<json> value = parse_toml_value(text);
  if (!value) value = parse_json_value(text);
  // A file may be called 7 or 2024-01-01, which TOML reads as a number or a date.
  const Key* found = find_key(key);
  const bool wordy = found && (found->kind == Kind::text || found->kind == Kind::choice ||
                               found->kind == Kind::path);
  return value && (!wordy || value->is_string()) ? *value : json(text);
}

std::map<std::string, json> changes_of(const json& block) {
  std::map<std::string, json> changes;
  for (const auto& [section, value] : block.items()) {
    if (section == "name") continue;
    if (!value.is_object()) {
      changes[section == "bone" ? "surgery.bone" : section] = value;
      continue;
    }
    for (const auto& [key, item] : value.items()) changes[section + "." + key] = item;
  }
  return changes;
}

}  // namespace hyperex::scene
