// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <vector>

#include "experiments/curves.hpp"
#include "experiments/study.hpp"

namespace hyperex::bench {

/// The shapes of three models at the end, and the distances of the second and third from the first.
void draw_model_maps(const Study& study,
                     const std::array<const simulate::SimulationResult*, 3>& models,
                     const std::filesystem::path& file);

/// Three panels: S(t), the differences of models 2 and 3 from model 1 in it, and the effect of the
/// tissue alone on xi_L - xi_R.
void add_model_panels(const std::string& face, const std::array<metrics::SymmetryCurve, 3>& curves,
                      std::vector<CurvePanel>& panels);

}  // namespace hyperex::bench
