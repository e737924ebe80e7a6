// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include "hyperex/metrics/soft_tissue_moves.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::run {

/// The landmarks of the midline that pictures and printed lines name, and how; from below.
inline constexpr std::array<std::pair<const char*, const char*>, 5> kSurgeryLandmarks = {
    {{"pogonion", "chin"},
     {"labiale_inferius", "lower lip"},
     {"labiale_superius", "upper lip"},
     {"subnasale", "base of the nose"},
     {"pronasale", "tip of the nose"}}};

/// Draws a PNG of the face before and after surgery, at rest and at the peak of base, from the
/// front and in profile. On its right: the change at rest as colours, and the outlines before and
/// after, with the millimetres of `moves`.
void draw_surgery(const Results& base, const session::VariantRun& run,
                  const std::vector<metrics::SoftTissueMove>& moves,
                  const std::filesystem::path& file);

}  // namespace hyperex::run
