// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// Sets the value of a key such as "tissue.young_kpa" in a table laid out like a scene file:
/// {"tissue": {"young_kpa": 300}}.
void put_value(nlohmann::json& table, const std::string& key, nlohmann::json value);

/// The text of a scene file that contains all values given in a scene's file and by overrides,
/// including its variants, with absolute paths. read_scene_text() of it gives the same scene.
std::string given_text(const Scene& scene);

}  // namespace hyperex::scene
