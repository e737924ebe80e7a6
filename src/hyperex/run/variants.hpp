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

/// The rows of base and its variants in "table" of "variants" in summary.json: displacements of the
/// corners (mm) and differences from base. Figures that depend on written files are not included.
nlohmann::ordered_json variant_table(const Results& base, const std::vector<VariantRun>& runs);

/// Writes variants.csv, the pictures of variants_picture.hpp and one folder per variant in
/// variants/. Returns the entry of summary.json on the variants.
nlohmann::ordered_json write_variants(const Results& base, const std::vector<VariantRun>& runs,
                                      const tissue::TissueMesh& mesh,
                                      const std::filesystem::path& directory);

}  // namespace hyperex::run
