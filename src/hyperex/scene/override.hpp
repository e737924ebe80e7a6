// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Overrides that stand in a file, as those of a study do, and not on the command line.
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// KEY=VALUE as --set takes it, with the place that messages name.
struct Override {
  std::string text;
  Origin origin = {"--set", 0};
  std::filesystem::path folder = {};  ///< relative paths in VALUE are taken from it
};

/// read_scene(file) with these overrides, the last of a key winning. Throws InputError as that
/// does.
Scene read_scene_with(const std::filesystem::path& file, const std::vector<Override>& overrides);

/// What a table of overrides changes: "tissue.young_kpa": 400 from {"tissue": {"young_kpa": 400}},
/// and what lies deeper as it is. "name" is the table's own and left out.
std::map<std::string, nlohmann::json> changes_of(const nlohmann::json& block);

/// What is expected where `name` is no key: "a known key (did you mean time.step_s?)", the new
/// name of a key that was renamed, or why a key was removed.
std::string unknown_key(const std::string& name);
/// The same of a section, "time"; and whether there is one of that name.
std::string unknown_section(const std::string& name);
bool is_section(const std::string& name);

}  // namespace hyperex::scene
