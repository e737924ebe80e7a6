// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/run/outputs.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::run {
using session::VariantRun;

/// Rows of base and its variants as "table" of "variants" in summary.json has them, without what is
/// known only of written files: millimetres of the corners, what differs from base.
nlohmann::ordered_json variant_table(const Results& base, const std::vector<VariantRun>& runs);

/// Writes variants.csv, the pictures of variants_picture.hpp and a folder a variant under
/// variants/, and returns what summary.json says of them.
nlohmann::ordered_json write_variants(const Results& base, const std::vector<VariantRun>& runs,
                                      const tissue::TissueMesh& mesh,
                                      const std::filesystem::path& directory);

}  // namespace hyperex::run
