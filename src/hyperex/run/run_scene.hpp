// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "hyperex/scene/scene.hpp"

namespace hyperex::run {

/// Runs a scene and writes all outputs into `directory`, which appears completely or not at all.
/// Notes are written to the log. Returns the summary (summary.json). Throws InputError and
/// NumericalError. `cancelled` (may be empty) is called often; if it returns true,
/// simulate::Cancelled is thrown and no files remain.
nlohmann::ordered_json run_scene(const scene::Scene& scene, const std::filesystem::path& directory,
                                 const std::function<bool()>& cancelled = {});

}  // namespace hyperex::run
