// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// Sets "tissue.young_kpa" in a table as a scene file has it: {"tissue": {"young_kpa": 300}}.
void put_value(nlohmann::json& table, const std::string& key, nlohmann::json value);

/// A scene file that gives what was given in a scene's file and by overrides, its variants too,
/// with absolute paths: read_scene_text() of it makes the same scene.
std::string given_text(const Scene& scene);

}  // namespace hyperex::scene
