// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// The rim of the mouth: the vertices, in order, of the border of the skin that is closest to the
/// inner lip points (ibug68_60 to 67). Empty if no border has a mean distance below 10 mm from
/// them, for example if the lips of a scan are joined.
std::vector<int> mouth_rim(const TriMesh& skin, const io::Landmarks& landmarks);

/// Measures of the smoothness of the rim of a displaced face.
struct MouthOutline {
  /// Sum of the angles between successive segments of the closed line, degrees: 360 for a flat
  /// convex outline, more for each dent. The line is resampled at 1 mm and smoothed along its
  /// length by a Gaussian of 1.5 mm, so that the noise of a scan has little effect.
  double turning_deg = 0;
  /// Largest difference between the displacements of neighbours on the rim.
  double largest_jump_mm = 0;
};

/// `displacement`: displacement of the skin, |V| x 3, m. Returns nothing if the rim has fewer than
/// four vertices.
std::optional<MouthOutline> mouth_outline(const TriMesh& skin, const std::vector<int>& rim,
                                          const PointsF& displacement);

}  // namespace hyperex::metrics
