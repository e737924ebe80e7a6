// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/grammar/override.hpp"

#include <fmt/format.h>

#include "hyperex/scene/grammar/keys.hpp"

namespace hyperex::scene {
using nlohmann::json;

namespace {
/// Keys of earlier scene files, and what they are named now.
const std::map<std::string, std::string> renamed_keys = {
    {"support.muscle_kpa_per_mm", "support.field_kpa_per_mm"}};
}  // namespace

std::string unknown_key(const std::string& name) {
  if (const auto renamed = renamed_keys.find(name); renamed != renamed_keys.end())
    return renamed->second + ", as this key is named now";
  std::vector<std::string> all;
  std::string siblings;
  for (const Key& key : keys()) {
    all.push_back(key.name);
    if (!section_of(name).empty() && section_of(key.name) == section_of(name))
      siblings += (siblings.empty() ? "" : ", ") + key.name.substr(section_of(name).size() + 1);
  }
  const std::string near = nearest(name, all);
  if (!near.empty()) return "a known key (did you mean " + near + "?)";
  if (!siblings.empty())
    return fmt::format("a known key ([{}] has {})", section_of(name), siblings);
  return "a known key (docs/scene.md lists them)";
}

std::map<std::string, json> changes_of(const json& block) {
  std::map<std::string, json> changes;
  for (const auto& [section, value] : block.items()) {
    if (section == "name") continue;
    if (!value.is_object()) {
      changes[section] = value;
      continue;
    }
    for (const auto& [key, item] : value.items()) changes[section + "." + key] = item;
  }
  return changes;
}

}  // namespace hyperex::scene
