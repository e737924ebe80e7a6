// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/session/inputs.hpp"
#include "hyperex/session/tissue_fields.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::session {

/// What a run simulates on one mesh: base, the scene without a variant, and its variants.
struct FaceOptions {
  std::optional<tissue::TissueField> field;  ///< where base's tissue differs from place to place
  simulate::SimulationOptions base;
  std::vector<VariantRun> runs;  ///< of scene.variants, with their options
};

/// Throws InputError for tissue that is invalid on this mesh and for options that do not go
/// together; the sentence names the key, that of a variant after "variant[0].".
FaceOptions face_options(const scene::Scene& scene, const Inputs& inputs, TissueFields& fields);

/// On the tissue of base and of the variants.
std::vector<Note> notes_on_tissue(const std::optional<tissue::TissueField>& base,
                                  const std::vector<VariantRun>& runs);

/// simulation_options() with the tissue of a field, where there is one.
simulate::SimulationOptions options_with_field(const scene::Scene& scene, const Inputs& inputs,
                                               const std::optional<tissue::TissueField>& field);

}  // namespace hyperex::session
