// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/override.hpp"

#include <fmt/format.h>

#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {
using nlohmann::json;

namespace {
/// Keys of earlier scene files, and what they are named now.
const std::map<std::string, std::string> renamed_keys = {
    {"support.muscle_kpa_per_mm", "support.field_kpa_per_mm"}};
/// Constants of a law in kPa, which follow from keys that are there: what to give in their place.
const std::map<std::string, std::string> derived_keys = {
    {"yeoh_c10", "tissue.young_kpa = 4 (1 + tissue.poisson) C10"},
    {"yeoh_c20", "tissue.yeoh_c20 = C20 / C10, with tissue.young_kpa = 4 (1 + tissue.poisson) C10"},
    {"yeoh_c30", "tissue.yeoh_c30 = C30 / C10, with tissue.young_kpa = 4 (1 + tissue.poisson) C10"},
    {"mooney_c10", "tissue.young_kpa = 4 (1 + tissue.poisson) (C10 + C01)"},
    {"mooney_c01",
     "tissue.mooney_c01 = C01 / C10, with tissue.young_kpa = 4 (1 + tissue.poisson) "
     "(C10 + C01)"},
    {"shear", "tissue.young_kpa = 2 (1 + tissue.poisson) mu"},
    {"mu", "tissue.young_kpa = 2 (1 + tissue.poisson) mu"},
    {"bulk", "tissue.poisson = (3 K - E) / (6 K), with E the tissue.young_kpa"}};

/// "tissue.yeoh_c10_kpa" is "yeoh_c10", "tissue.c10" too.
std::string derived_key(const std::string& name) {
  if (section_of(name) != "tissue") return {};
  std::string stem = name.substr(7);
  for (const char* ending : {"_modulus", "_kpa", "_pa", "_modulus"})
    if (stem.ends_with(ending)) stem.erase(stem.size() - std::string(ending).size());
  if (stem == "c10" || stem == "c20" || stem == "c30") stem = "yeoh_" + stem;
  if (stem == "c01") stem = "mooney_c01";
  const auto derived = derived_keys.find(stem);
  return derived == derived_keys.end() ? std::string() : derived->second;
}
}  // namespace

std::string unknown_key(const std::string& name) {
  if (const auto renamed = renamed_keys.find(name); renamed != renamed_keys.end())
    return renamed->second + ", as this key is named now";
  if (const std::string derived = derived_key(name); !derived.empty())
    return "what it follows from: " + derived;
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
