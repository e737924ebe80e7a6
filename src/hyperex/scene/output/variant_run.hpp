// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/scene/output/outputs.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::scene {

/// One variant's run on the mesh and motion of base, the scene without a variant.
struct VariantRun {
  std::string folder;                        ///< of its outputs, in variants/
  Scene scene;                               ///< the variant's; output.* says what its folder holds
  Inputs inputs;                             ///< the scene's, with the variant's driven points
  std::optional<tissue::TissueField> field;  ///< where the tissue differs from place to place
  reenact::SimulationResult simulation;
  metrics::SymmetryMeasures symmetry;
};

}  // namespace hyperex::scene
