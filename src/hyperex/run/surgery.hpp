// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/run/outputs.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::run {
using session::VariantRun;

/// Whether a variant changes the face at rest otherwise than base does: moves other bones, or adds
/// another volume.
bool changes_rest(const Results& base, const VariantRun& run);

/// Writes surgery.csv (metrics/soft_tissue_moves.hpp) and surgery.png into the folder of a variant
/// that changes the face at rest.
void write_surgery(const Results& base, const VariantRun& run,
                   const std::filesystem::path& directory);

/// "surgery" of such a variant's row in summary.json.
nlohmann::ordered_json surgery_json(const Results& base, const VariantRun& run);

/// What each such variant does to the face at rest, one line per variant: "  advancement, at rest:
/// chin 5.6 mm (0.94 of the bone; published 0.80 to 1.33), lower lip 4.4 mm (...)". Where volume is
/// added: "  filler, at rest: 2 ml added, of which 1.7 ml show at the skin; it moves by up to 3.1
/// mm".
std::string surgery_lines(const nlohmann::ordered_json& summary);

}  // namespace hyperex::run
