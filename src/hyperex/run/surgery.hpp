// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "hyperex/run/outputs.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::run {
using session::VariantRun;

/// Writes surgery.csv (metrics/soft_tissue_moves.hpp) and surgery.png into the folder of a variant
/// in which bones are moved.
void write_surgery(const Results& base, const VariantRun& run,
                   const std::filesystem::path& directory);

/// "surgery" of such a variant's row in summary.json.
nlohmann::ordered_json surgery_json(const Results& base, const VariantRun& run);

}  // namespace hyperex::run
