// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::run {

/// The whole chain: reads, meshes, simulates, writes everything into `directory`, which appears
/// complete or not at all. Returns the summary (summary.json). Throws InputError, NumericalError.
nlohmann::ordered_json run_scene(const scene::Scene& scene, const std::filesystem::path& directory);

/// What reading a scene's inputs has to say, a sentence each.
struct Checked {
  std::vector<std::string> notes;     ///< what was guessed or placed, and what was not checked
  std::vector<std::string> warnings;  ///< what is probably wrong (Inputs::warnings)
};

/// Reads everything, what takes long as far as Look::quick does, and simulates nothing.
/// Throws InputError with every problem found.
Checked check_scene(const scene::Scene& scene);

}  // namespace hyperex::run
