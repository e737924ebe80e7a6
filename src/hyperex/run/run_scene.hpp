// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "hyperex/scene/scene.hpp"

namespace hyperex::run {

/// A session of the scene, run, and all its outputs in `directory`, which appears complete or not
/// at all. What was found is logged. Returns the summary (summary.json). Throws InputError,
/// NumericalError; where `cancelled` (may be empty; asked often) returns true simulate::Cancelled,
/// and then nothing is left.
nlohmann::ordered_json run_scene(const scene::Scene& scene, const std::filesystem::path& directory,
                                 const std::function<bool()>& cancelled = {});

}  // namespace hyperex::run
