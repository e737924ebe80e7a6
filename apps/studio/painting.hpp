// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Painted regions, written as the files that tissue.region and mesh.thickness_region name.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::studio {

/// Writes a painted region into `folder` and returns the file's name: a CSV with a column `weight`
/// and one row per vertex of the scan (of the whole scan where it was thinned). The name is a hash
/// of the contents, so the same paint is the same file. `vertices`: of the skin; `shares`: one for
/// each of them, in (0, 1]; other vertices have 0. Throws InputError for anything else.
std::string write_painting(const tissue::TissueMesh& mesh, const nlohmann::json& vertices,
                           const nlohmann::json& shares, const std::filesystem::path& folder);

}  // namespace hyperex::studio
