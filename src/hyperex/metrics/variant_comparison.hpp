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

/// A run to be compared. All runs must have the same skin, frame times and landmark names.
struct ComparedRun {
  const simulate::Performance& performance;
  const SymmetryMeasures& symmetry;  ///< including its map
};

/// The input data of the base, the run with which the others are compared.
struct ComparedInputs {
  const io::Landmarks& landmarks;  ///< at rest, including ibug68_48 to 59
  const motion::Motion& recorded;  ///< in the scan's frame; its first time is time 0 of the run
};

/// The points between which lag and hysteresis are computed: the driven point with the greatest
/// displacement in base, and the response, which is the landmark with the greatest displacement
/// among those farther than `clear_m` from every driven point at rest.
struct ResponsePair {
  std::string driven, response;  ///< empty if there is none
};
ResponsePair response_pair(const simulate::Performance& base, const motion::Motion& recorded,
                           double clear_m);

/// The greatest distance over time between a point in this run and in base at the same time, less
/// that between the two in the first sample, which surgery makes. It shows differences that the
/// excursion does not: for example, a weaker smile while the opening jaw moves the point farther.
struct DistanceFromBase {
  double most_mm = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the point is unknown
  double time_s = std::numeric_limits<double>::quiet_NaN();   ///< of the run
};
DistanceFromBase distance_from_base(const motion::Motion& base, const motion::Motion& run,
                                    int column);

/// The displacement of a point along its main direction in base, mm. d is its displacement since
/// the first sample; u is the direction of d in base where |d| is greatest. The result is d.u with
/// its sign, at the time of greatest |d.u|; for base itself this is the excursion. A distance from
/// rest has no direction: a weak mouth corner that the other side pulls across may be as far from
/// rest as before. NaN if the point is unknown or if its displacement in base is below 0.1 mm.
double along_base_mm(const motion::Motion& base, const motion::Motion& run, int column);
/// The same of two tracks of one point, N x 3, mm; NaN where they are empty.
double along_base_mm(const Points& base_mm, const Points& run_mm);

/// Comparison of a run with base. "Peak" is the peak of base.
struct VariantComparison {
  std::string name;
  double greatest_displacement_mm = 0;
  VariantDifference difference;     ///< of the skin's vertices, relative to base
  double greatest_distance_mm = 0;  ///< greatest distance of any vertex from base, over time
  std::string farthest_near;  ///< landmark nearest to that vertex; empty if all distances are 0
  /// Displacement of that vertex at the peak, in this run and in base; NaN if there is no such
  /// vertex.
  double displacement_there_mm = 0, base_displacement_there_mm = 0;
  /// At the peak, averaged over the area of the skin.
  double rms_distance_mm = 0, mean_change_mm = 0;
  /// Displacement at the peak, averaged over the area of the face on the subject's left and right;
  /// NaN without a plane.
  double mean_displacement_left_mm = 0, mean_displacement_right_mm = 0;
  /// Excursions of the corners of the mouth; NaN if these are unknown.
  ExcursionChange commissure_left, commissure_right;
  DistanceFromBase left_from_base, right_from_base;  ///< for the same corners
  /// along_base_mm() of the same corners in base and in this run. The band has the parts of
  /// ExcursionChange: the twins' motion along their own direction in base, and the jitter that a
  /// changed face scales. Jitter across the direction turns both runs alike, to first order.
  ExcursionChange left_along_base, right_along_base;
  double asymmetry_mm = 0;  ///< at the peak, root mean square over the face
  /// Greatest change of xi_L - xi_R relative to base, with its sign.
  double added_xi_difference = 0;
  /// Floor of that change due to the mesh (added_mesh_floor); NaN: unknown.
  double added_xi_floor = 0;
  /// 1 if it is above the floor, otherwise 0; NaN if no floor is known.
  double added_xi_decided() const {
    if (std::isnan(added_xi_floor)) return added_xi_floor;
    return std::abs(added_xi_difference) > added_xi_floor ? 1 : 0;
  }
  /// Whether the jitter of the recording is known; 0 may be known. Otherwise the bands of the
  /// corners are NaN.
  bool jitter_known = true;
  /// Share of the area-weighted sum of squared distances (greatest over time) within 25 mm of the
  /// outline of the lips; NaN if all distances are 0.
  double share_near_mouth = 0;
  /// Lag of the response point relative to the driven point. NaN if the motion does not return
  /// towards rest, because a lag cannot then be distinguished from a curved path.
  Lag lag;
  double hysteresis = 0;           ///< of the same pair; NaN under the same condition
  double symmetry_integral_s = 0;  ///< integral of |xi_L - xi_R| over time
};

/// `run` may be the base itself; all differences are then 0. Throws std::invalid_argument if the
/// numbers of vertices or frames differ (variant_difference).
VariantComparison compare_variant(const std::string& name, const ComparedRun& base,
                                  const ComparedRun& run, const ComparedInputs& inputs,
                                  const ResponsePair& pair);

}  // namespace hyperex::metrics
