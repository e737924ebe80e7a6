// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/run/outputs.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::run {

/// One variant's run on the mesh and motion of base, the scene without a variant.
struct VariantRun {
  std::string folder;                        ///< of its outputs, in variants/
  scene::Scene scene;                        ///< the variant's; output.* says what its folder holds
  session::Inputs inputs;                    ///< the scene's, with the variant's driven points
  std::optional<tissue::TissueField> field;  ///< where the tissue differs from place to place
  simulate::SimulationResult simulation;
  metrics::SymmetryMeasures symmetry;
};

}  // namespace hyperex::run
