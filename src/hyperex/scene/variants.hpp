// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/metrics/lag.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/metrics/variant_difference.hpp"
#include "hyperex/scene/outputs.hpp"
#include "hyperex/scene/tissue_fields.hpp"

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

/// The runs of scene.variants, not simulated yet. Mesh, landmarks, motion and its alignment are the
/// scene's own. Throws InputError naming the variant's key for tissue that cannot be.
std::vector<VariantRun> prepare_variants(const Scene& scene, const Inputs& inputs,
                                         TissueFields& fields);

/// Simulates all at once, each from the stages that base's simulator and its twin's have.
/// Throws NumericalError naming the variant that cannot be solved.
void simulate_variants(std::vector<VariantRun>& runs, const reenact::Simulator& base,
                       const MirroredTwin& base_twin, const metrics::RestAsymmetry& at_rest);

/// A run against the scene's own. "Peak" is the scene's own.
struct VariantComparison {
  std::string name;
  double greatest_displacement_mm = 0;
  metrics::VariantDifference difference;  ///< to base; of the skin's vertices
  double greatest_distance_mm = 0;        ///< of any vertex, over time
  std::string farthest_near;  ///< the landmark nearest to that vertex; empty: no distance
  /// At the peak, of that vertex: in this run and in base; NaN where there is none.
  double displacement_there_mm = 0, base_displacement_there_mm = 0;
  double rms_distance_mm = 0, mean_change_mm = 0;  ///< at the peak, over the skin's area
  /// At the peak, mean over the face's area on the subject's left and right; NaN without a plane.
  double mean_displacement_left_mm = 0, mean_displacement_right_mm = 0;
  /// How far the corners of the mouth travel; NaN where they are not known.
  metrics::ExcursionChange commissure_left, commissure_right;
  double asymmetry_mm = 0;  ///< at the peak, root mean square over the face
  /// What the variant adds to xi_L - xi_R, where it adds most.
  double added_xi_difference = 0;
  double added_xi_floor = 0;  ///< what the mesh makes of that (added_mesh_floor); NaN: unknown
  /// 1 where it is above the floor, else 0; NaN where no floor is known.
  double added_xi_decided() const {
    if (std::isnan(added_xi_floor)) return added_xi_floor;
    return std::abs(added_xi_difference) > added_xi_floor ? 1 : 0;
  }
  /// Share of the summed squared distances (greatest over time, weighted with area) within 25 mm of
  /// the outline of the lips; NaN where all are 0.
  double share_near_mouth = 0;
  /// Of the response point behind the driven point; NaN where the motion does not come back: a
  /// shape that is still on its way tells no lag from a bent path.
  metrics::Lag lag;
  double hysteresis = 0;           ///< of the same pair; NaN as the lag
  double symmetry_integral_s = 0;  ///< of |xi_L - xi_R| over time
};

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
