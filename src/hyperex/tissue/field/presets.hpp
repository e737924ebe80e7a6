// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

/// Published tissue parameters (data/presets.toml, built into the program).
struct TissuePreset {
  std::string name, summary, source;
  GivenParameters uniform{}, factor{};  ///< factor: multiplies all values, also those at points
  std::vector<TissuePoint> points;
  std::vector<TissueLayer> layers;
};

/// In the order of the file; parsed at the first call.
const std::vector<TissuePreset>& tissue_presets();
/// Null if there is no preset of that name.
const TissuePreset* find_preset(const std::string& name);

/// The value of each parameter away from points and regions: from the options, otherwise from the
/// preset, otherwise the default.
TissueParameters uniform_parameters(const TissueFieldOptions& options);

}  // namespace hyperex::tissue
