// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Outputs are passed on to others, and the folders of the inputs may contain a patient's name.
// Outputs therefore contain the names of a scene's files without their folders, unless
// output.full_paths is set.
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// options_json(scene) with each path replaced by `named(path)`, also in rows of tables.
nlohmann::json options_with_paths(const Scene& scene,
                                  const std::function<std::string(const std::string&)>& named);

/// options_json(scene), with file names for paths unless output.full_paths is set.
nlohmann::json echoed_options(const Scene& scene);

/// The changes of a variant, by key, with paths treated in the same way.
nlohmann::json echoed_changes(const Scene& scene, const nlohmann::json& changes);

/// A note with paths treated in the same way. Messages from readers of files may contain the paths
/// of the scene's inputs, or of files inside them.
std::string with_file_names(const Scene& scene, std::string note);

}  // namespace hyperex::scene
