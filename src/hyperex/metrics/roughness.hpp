// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// How crumpled a motion makes the skin: what it moves each vertex in and out by beyond a smooth
/// motion of the skin around. Within `kRoughnessReach_m` of a vertex, along the skin's edges, the
/// displacements' components along its normal are fitted by an affine function of the place in its
/// tangent plane; the rest at the vertex itself is its roughness. Stretching, turning and bending
/// over longer ways count little; dents as wide as the reach, patch by patch, count whole. The
/// surface at rest does not enter: a rough scan that moves smoothly has none.
struct Roughness {
  double rms_mm = 0;  ///< over all vertices that are judged
  double p99_mm = 0;  ///< 99th percentile
  double greatest_mm = 0;
  int roughest = -1;        ///< the vertex; -1 where none is judged
  Eigen::Index judged = 0;  ///< those that have neighbours on all sides: none near a border
};

inline constexpr double kRoughnessReach_m = 0.006;

/// `displacement`: of the skin, |V| x 3, m.
Roughness roughness(const TriMesh& skin, const PointsF& displacement);

}  // namespace hyperex::metrics
