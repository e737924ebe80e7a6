// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::run {

/// The files that a run wrote into `folder`, relative to it and with '/' between: "files" in its
/// summary.json, where that says "program": "hyperex". Of a run from before there was such a list,
/// those that stand there under the names of outputs. None where no run is known to have written
/// there.
std::set<std::string> files_of_earlier_run(const std::filesystem::path& folder);

/// Every file and folder that a scene and its variants name, and the scene file.
std::vector<std::filesystem::path> files_named_by(const scene::Scene& scene);

}  // namespace hyperex::run
