// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::run {

/// Whether the summary.json in `folder` is that of a run, and not of another command.
bool is_folder_of_run(const std::filesystem::path& folder);

/// The files that a run wrote into `folder`, relative to it, with '/' as separator. They are
/// "files" in its summary.json, if that contains "program": "hyperex". Earlier versions wrote no
/// such list; for their folders, the existing files with names of outputs are returned. Empty if no
/// run is known to have written there.
std::set<std::string> files_of_earlier_run(const std::filesystem::path& folder);

/// Every file and folder that a scene and its variants name, and the scene file.
std::vector<std::filesystem::path> files_named_by(const scene::Scene& scene);

}  // namespace hyperex::run
