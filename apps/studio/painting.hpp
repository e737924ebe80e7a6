// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What is painted on the skin, as files that tissue.region and mesh.thickness_region name.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::studio {

/// Writes a region painted on the skin into `folder`, as a CSV with a column `weight` and a row a
/// vertex of the scan (of one that was thinned, of the whole scan), and returns its name, which is
/// made of what the file holds: the same paint is the same file. `vertices` of the skin and, for
/// each, the share in `shares`, above 0 to 1; all others 0. Throws InputError for anything else.
std::string write_painting(const tissue::TissueMesh& mesh, const nlohmann::json& vertices,
                           const nlohmann::json& shares, const std::filesystem::path& folder);

}  // namespace hyperex::studio
