// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// The rim of the mouth: the skin's border next to the inner lip points (ibug68_60 to 67), its
/// vertices in order. Empty where none lies within 10 mm of them in the mean, as of a scan whose
/// lips are joined.
std::vector<int> mouth_rim(const TriMesh& skin, const io::Landmarks& landmarks);

/// How smooth the rim of a moved face is.
struct MouthOutline {
  /// Sum of the angles between successive pieces of the closed line, degrees: 360 of a flat convex
  /// outline, more for each dent. The line is sampled each millimetre and smoothed by a Gaussian of
  /// 1.5 mm along it, so that a scan's noise does not count.
  double turning_deg = 0;
  double largest_jump_mm = 0;  ///< between the displacements of two neighbours on the rim
};

/// `displacement`: of the skin, |V| x 3, m. Nothing where the rim has fewer than four vertices.
std::optional<MouthOutline> mouth_outline(const TriMesh& skin, const std::vector<int>& rim,
                                          const PointsF& displacement);

}  // namespace hyperex::metrics
