// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/mirrored_twin.hpp"
#include "hyperex/session/tissue_fields.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::session {

/// One variant's run on the mesh and motion of base, the scene without a variant.
struct VariantRun {
  std::string folder;  ///< of its outputs, in variants/
  scene::Scene scene;  ///< the variant's; output.* selects the files of its folder
  Inputs inputs;       ///< the scene's, with the variant's driven points
  std::optional<tissue::TissueField> field;  ///< where the tissue differs from place to place
  simulate::SimulationOptions options;
  simulate::SimulationResult simulation;
  metrics::SymmetryMeasures symmetry;
};

/// The runs of scene.variants, not simulated yet. Mesh, landmarks, motion and its alignment are the
/// scene's own. Throws InputError naming the variant's key for invalid tissue.
std::vector<VariantRun> prepare_variants(const scene::Scene& scene, const Inputs& inputs,
                                         TissueFields& fields);

/// The warning `variant.left_out`, for whoever has opened the scene without this variant. It is
/// about the scene: no face of the session bears this name.
Note left_out_warning(const scene::LeftOutVariant& variant);

}  // namespace hyperex::session
