// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <set>
#include <string>

#include "hyperex/ct/ct_face.hpp"

namespace hyperex::ct {

/// The files that an earlier call wrote into the folder, by its summary.json.
std::set<std::string> files_of_earlier_ct(const std::filesystem::path& folder);

/// Writes everything into `folder`, which exists. Surfaces in mm.
void write_ct(const CtFace& face, const std::filesystem::path& folder);

}  // namespace hyperex::ct
