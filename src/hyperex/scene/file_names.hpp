// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Outputs are passed on, and the folders that inputs lie in may tell a patient's name: what is
// written of a scene names its files without their folders, unless output.full_paths is set.
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// options_json(scene) with `named(path)` in the place of each path, those in rows of tables too.
nlohmann::json options_with_paths(const Scene& scene,
                                  const std::function<std::string(const std::string&)>& named);

/// options_json(scene).
nlohmann::json echoed_options(const Scene& scene);

/// Changes of a variant, by key.
nlohmann::json echoed_changes(const Scene& scene, const nlohmann::json& changes);

/// A note, in which messages of readers may name the scene's inputs or files inside of them.
std::string with_file_names(const Scene& scene, std::string note);

}  // namespace hyperex::scene
