// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/scene/output/variant_run.hpp"
#include "hyperex/scene/stages/tissue_fields.hpp"

namespace hyperex::scene {

/// The runs of scene.variants, not simulated yet. Mesh, landmarks, motion and its alignment are the
/// scene's own. Throws InputError naming the variant's key for tissue that cannot be.
std::vector<VariantRun> prepare_variants(const Scene& scene, const Inputs& inputs,
                                         TissueFields& fields);

/// Simulates all at once, each from the stages that base's simulator and its twin's have.
/// Throws NumericalError naming the variant that cannot be solved.
void simulate_variants(std::vector<VariantRun>& runs, const reenact::Simulator& base,
                       const MirroredTwin& base_twin, const metrics::RestAsymmetry& at_rest);

/// What lags and hysteresis are told of: the driven point that moves farthest in base,
/// and the landmark that moves farthest of those off all driven patches.
struct ResponsePair {
  std::string driven, response;  ///< empty where there is none
};
ResponsePair response_pair(const Results& base);

/// `run` may be the base itself: all differences are 0 then.
VariantComparison compare_variant(const std::string& name, const Results& base, const Results& run,
                                  const ResponsePair& pair);

/// Writes variants.csv, the pictures of variants_picture.hpp and a folder a variant under
/// variants/, and returns what summary.json says of them.
nlohmann::ordered_json write_variants(const Results& base, const std::vector<VariantRun>& runs,
                                      const tissue::TissueMesh& mesh,
                                      const std::filesystem::path& directory);

}  // namespace hyperex::scene
