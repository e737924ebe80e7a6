// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// The groove of a profile: heights at equal steps, mm.
struct Groove {
  double depth_mm = 0;  ///< 0: none
  double place_mm = 0;  ///< of its deepest point, along the profile from its first sample
};

/// The greatest distance of the profile below a straight line between two of its own points, which
/// are 2 to 20 mm apart. Samples that are NaN end the profile.
Groove groove_of(const std::vector<double>& height_mm, double step_mm);

/// The fold from nose to mouth (nasolabial fold) where a cut crosses it.
struct FoldCut {
  /// NaN where the surface has a hole, or ends less than 20 mm outwards.
  double depth_mm = 0;
  /// Distance of the deepest point, outwards, from the line between the wing of the nose and the
  /// corner of the mouth; NaN where the groove is shallower than 0.5 mm.
  double outward_mm = 0;
};

/// Cuts at 0.3, 0.5 and 0.7 of the way from the wing of the nose (iBUG points 31, 35) to the corner
/// of the mouth (48, 54), at right angles to that line as seen from the front (face_frame), from 6
/// mm on the side of the nose to 26 mm on the side of the cheek. Each profile is smoothed by a
/// Gaussian of 1 mm. The fold of a real smile is 3.8 mm deep, and keeps 3.6 mm in points 4 mm
/// apart. `landmarks`: complete, of this surface.
std::array<FoldCut, 3> fold_cuts(const TriMesh& skin, const io::Landmarks& landmarks, bool left);

}  // namespace hyperex::metrics
