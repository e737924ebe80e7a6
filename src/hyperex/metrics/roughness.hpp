// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// Roughness of a displacement field of the skin: its normal component minus a smooth fit. At each
/// vertex, the components of the displacements along the vertex normal are fitted by an affine
/// function of the position in the tangent plane. The fit uses the vertices within
/// `kRoughnessReach_m` along the edges. The residual at the vertex itself is its roughness.
/// Stretching, rotation and bending over greater lengths contribute little; dents about as wide as
/// the reach contribute fully. The shape at rest has no effect: a rough scan with a smooth motion
/// has no roughness.
struct Roughness {
  double rms_mm = 0;  ///< over all evaluated vertices
  double p99_mm = 0;  ///< 99th percentile
  double greatest_mm = 0;
  int roughest = -1;  ///< vertex with the greatest value; -1 if none is evaluated
  /// Number of evaluated vertices: those with neighbours on all sides, not near a border.
  Eigen::Index judged = 0;
  Eigen::VectorXd vertex_mm;  ///< per vertex; NaN where it is not evaluated
};

inline constexpr double kRoughnessReach_m = 0.006;

/// `displacement`: of the skin, |V| x 3, m.
Roughness roughness(const TriMesh& skin, const PointsF& displacement);

/// A part of the face where driven points may crumple the skin.
struct PartRoughness {
  std::string part;   ///< "brows", "forehead", "corners" (of the mouth), "chin"
  double rms_mm = 0;  ///< over its evaluated vertices
};
/// brows: within 12 mm of ibug68_17 to 26; corners: within 12 mm of ibug68_48 and 54; forehead and
/// chin as in regions.hpp. A part without evaluated vertices or landmarks is left out.
std::vector<PartRoughness> roughness_by_part(const Roughness& rough, const Points& rest,
                                             const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
