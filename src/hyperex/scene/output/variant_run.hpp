// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <optional>
#include <string>

#include "hyperex/metrics/lag.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/metrics/variant_difference.hpp"
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

}  // namespace hyperex::scene
