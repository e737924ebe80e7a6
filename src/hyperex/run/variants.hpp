// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/run/variant_run.hpp"
#include "hyperex/session/tissue_fields.hpp"

namespace hyperex::run {

/// The runs of scene.variants, not simulated yet. Mesh, landmarks, motion and its alignment are the
/// scene's own. Throws InputError naming the variant's key for tissue that cannot be.
std::vector<VariantRun> prepare_variants(const scene::Scene& scene, const session::Inputs& inputs,
                                         session::TissueFields& fields);

/// Simulates all at once, each from the stages that base's simulator and its twin's have.
/// Throws NumericalError naming the variant that cannot be solved.
void simulate_variants(std::vector<VariantRun>& runs, const simulate::Simulator& base,
                       const session::MirroredTwin& base_twin,
                       const metrics::RestAsymmetry& at_rest);

/// A note for each variant whose lips pass through each other by so much, and farther than base's,
/// of which the run tells by itself.
inline constexpr double kLipsPass_mm = 0.5;
std::vector<std::string> lips_that_pass(const std::vector<VariantRun>& runs, double base_mm);

/// A note for each variant that changes the strength of muscles none of which the recording uses by
/// more than its own uncertainty (1 sigma): what such a variant changes is hardly known.
std::vector<std::string> gains_hardly_known(const simulate::MuscleCourse& base,
                                            const std::vector<VariantRun>& runs);

/// Rows of base and its variants as "table" of "variants" in summary.json has them, without what is
/// known only of written files: millimetres of the corners, what differs from base.
nlohmann::ordered_json variant_table(const Results& base, const std::vector<VariantRun>& runs);

/// Writes variants.csv, the pictures of variants_picture.hpp and a folder a variant under
/// variants/, and returns what summary.json says of them.
nlohmann::ordered_json write_variants(const Results& base, const std::vector<VariantRun>& runs,
                                      const tissue::TissueMesh& mesh,
                                      const std::filesystem::path& directory);

}  // namespace hyperex::run
