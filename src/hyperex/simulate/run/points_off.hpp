// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/simulate/run/readout.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// The driven point that ends farthest from where it is driven, and what may explain it.
struct FarthestPoint {
  std::string name;
  double off_m = 0;
  /// Greatest distance, in any frame, between its recorded place and the straight line between its
  /// recorded places at the ends of the time step: frames are interpolated between steps.
  double between_steps_m = 0;
  double from_mesh_m = 0;  ///< at rest, from the place of the mesh that it follows
  double edge_m = 0;       ///< longest edge of the mesh's outer triangles at that place
  /// The nearest driven point whose recorded displacement differs from its own by off_m or more in
  /// some frame; empty where there is none.
  std::string neighbour;
  double neighbour_m = std::numeric_limits<double>::infinity();  ///< distance at rest
  double shared = 0;  ///< share (0 to 1) of the nodes' weights that the neighbour has too
};

/// `off_m`: DrivenPoints::off_m, at least one. `step_s`: of time.
FarthestPoint farthest_point(const tissue::TissueMesh& mesh, const DrivenPoints& driven,
                             const PointCurve& wanted, const std::vector<double>& frame_time_s,
                             double step_s, const std::vector<double>& off_m);

/// "3 driven points end up to 0.74 mm from where they are driven, the farthest: ibug68_48 (corner
/// of the mouth, right), ibug68_54 (corner of the mouth, left)", of the points that are off by more
/// than `within_m`: the two farthest, eight where one is off by 2 mm or more. Empty where none is.
/// `off_m`: one per name.
std::string points_off_text(const std::vector<std::string>& names, const std::vector<double>& off_m,
                            double within_m);

/// Whether jitter of the recording alone may move a point as far: 95 % of errors whose standard
/// deviation is `jitter_m` per coordinate are shorter than 2.8 jitter_m in space. False where the
/// jitter is not known (NaN).
bool is_within_jitter(double off_m, double jitter_m);
/// "the recording's jitter of 0.20 mm alone moves a point by up to 0.56 mm (95 %)"
std::string jitter_text(double jitter_m);

/// Whether points end elsewhere because the options change the muscles' forces, by a gain other
/// than 1 or by mirroring, and neither step nor mesh explains the farthest one: it is a result
/// then, no fault.
bool is_asked_for(const FarthestPoint& point, const SimulationOptions& options);
/// Why the point ends elsewhere than it is driven, as a part of a sentence. Empty where no cause
/// can be established. `touched`: contact changed some frame.
std::string reason_of(const FarthestPoint& point, const SimulationOptions& options, bool touched);
/// What is likely where reason_of() is empty, as a part of a sentence.
std::string likely_reason(bool touched);

}  // namespace hyperex::simulate
