// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "hyperex/metrics/variant_comparison.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::run {
using session::VariantRun;

/// The face of the scene and of each variant at the scene's peak, from the front and three-quarter,
/// coloured by the greatest distance over time from base, to a scale on which none of
/// the others is lost beside one that moves much more. One comparison a run.
void draw_variants(const Results& base, const std::vector<metrics::VariantComparison>& compared,
                   const std::vector<VariantRun>& runs, const std::filesystem::path& file);

/// S(t) of all with the noise floor, and what each adds to xi_L - xi_R. Nothing where the scene has
/// one frame.
void draw_variant_symmetry(const Results& base, const std::vector<VariantRun>& runs,
                           const std::filesystem::path& file);

}  // namespace hyperex::run
