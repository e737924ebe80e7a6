// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

/// Published tissue parameters (data/presets.toml, built into the program).
struct TissuePreset {
  std::string name, summary, source;
  GivenParameters uniform{}, factor{};  ///< factor: on everything, points included
  std::vector<TissuePoint> points;
};

/// In the order of the file; parsed at the first call.
const std::vector<TissuePreset>& tissue_presets();
/// Null where there is none of that name.
const TissuePreset* find_preset(const std::string& name);

/// The value of each parameter away from points and regions: that of the options, else of the
/// preset, else the default.
TissueParameters uniform_parameters(const TissueFieldOptions& options);

}  // namespace hyperex::tissue
