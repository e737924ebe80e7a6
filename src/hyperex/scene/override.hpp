// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Overrides that come from a file, such as those of a study, not from the command line.
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// KEY=VALUE as for --set, with its place for messages.
struct Override {
  std::string text;
  Origin origin = {"--set", 0};
  std::filesystem::path folder = {};  ///< relative paths in VALUE are relative to it
};

/// read_scene(file) with these overrides; the last override of a key wins. Throws InputError as
/// read_scene() does.
Scene read_scene_with(const std::filesystem::path& file, const std::vector<Override>& overrides);

/// VALUE of KEY=VALUE, for a key of a scene: as in a scene file, else as JSON ({"side_R": 0.3}),
/// else `text` itself. Of a key whose values are words it is a string in any case.
nlohmann::json override_value(const std::string& key, const std::string& text);

/// The changes in a table of overrides, by key: "tissue.young_kpa": 400 from {"tissue":
/// {"young_kpa": 400}}. Values that are themselves tables stay as they are. "name" is the name of
/// the table itself and is left out.
std::map<std::string, nlohmann::json> changes_of(const nlohmann::json& block);

/// The expected text where `name` is not a key: "a known key (did you mean time.step_s?)", the new
/// name of a key that was renamed, or why a key was removed.
std::string unknown_key(const std::string& name);
/// The same for a section, "time", and whether there is one of that name.
std::string unknown_section(const std::string& name);
bool is_section(const std::string& name);

}  // namespace hyperex::scene
