// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/metrics/lag.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/metrics/variant_difference.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::metrics {

/// A run of a face as it is compared: all runs have the skin, the frame times and the names of
/// landmarks in common.
struct ComparedRun {
  const simulate::Performance& performance;
  const SymmetryMeasures& symmetry;  ///< with its map
};

/// What the run that others are compared with, base, was made from.
struct ComparedInputs {
  const io::Landmarks& landmarks;  ///< at rest, with ibug68_48 to 59
  const motion::Motion& recorded;  ///< in the scan's frame; its first time is the run's time 0
};

/// The points for which lag and hysteresis are reported: the driven point that moves farthest in
/// base, and the landmark that moves farthest of those more than `clear_m` from every driven point
/// at rest.
struct ResponsePair {
  std::string driven, response;  ///< empty where there is none
};
ResponsePair response_pair(const simulate::Performance& base, const motion::Motion& recorded,
                           double clear_m);

/// How far a point lies from its place in base at the same time, where that is most. It sees what
/// the change of an excursion does not: a weaker smile while the jaw, which moves the point
/// farther, opens.
struct DistanceFromBase {
  double most_mm = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the point is not known
  double time_s = std::numeric_limits<double>::quiet_NaN();   ///< of the run
};
DistanceFromBase distance_from_base(const motion::Motion& base, const motion::Motion& run,
                                    int column);

/// How far a point goes along the way that it goes in base: with d its displacement since the first
/// sample and u the direction of base's d where that is greatest, the value of d.u of the greatest
/// size, with its sign, mm. Of base itself that is its excursion. A distance from rest has no
/// direction: a weak corner that the other side drags back may be as far from rest as before. NaN
/// where the point is not known or base moves it by less than a tenth of a millimetre.
double along_base_mm(const motion::Motion& base, const motion::Motion& run, int column);

/// A run against the scene's own. "Peak" is the scene's own.
struct VariantComparison {
  std::string name;
  double greatest_displacement_mm = 0;
  VariantDifference difference;     ///< to base; of the skin's vertices
  double greatest_distance_mm = 0;  ///< of any vertex, over time
  std::string farthest_near;        ///< the landmark nearest to that vertex; empty: no distance
  /// At the peak, of that vertex: in this run and in base; NaN where there is none.
  double displacement_there_mm = 0, base_displacement_there_mm = 0;
  double rms_distance_mm = 0, mean_change_mm = 0;  ///< at the peak, over the skin's area
  /// At the peak, mean over the face's area on the subject's left and right; NaN without a plane.
  double mean_displacement_left_mm = 0, mean_displacement_right_mm = 0;
  /// How far the corners of the mouth travel; NaN where they are not known.
  ExcursionChange commissure_left, commissure_right;
  DistanceFromBase left_from_base, right_from_base;  ///< of the same corners
  /// Of the same corners: along_base_mm().
  double left_along_base_mm = std::numeric_limits<double>::quiet_NaN();
  double right_along_base_mm = std::numeric_limits<double>::quiet_NaN();
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
  /// Lag of the response point behind the driven point; NaN where the motion does not come
  /// back: on the way out alone, a lag looks like a bent path.
  Lag lag;
  double hysteresis = 0;           ///< of the same pair; NaN as the lag
  double symmetry_integral_s = 0;  ///< of |xi_L - xi_R| over time
};

/// `run` may be the base itself: all differences are 0 then. Throws std::invalid_argument where
/// skins or frames differ in number (variant_difference).
VariantComparison compare_variant(const std::string& name, const ComparedRun& base,
                                  const ComparedRun& run, const ComparedInputs& inputs,
                                  const ResponsePair& pair);

}  // namespace hyperex::metrics
