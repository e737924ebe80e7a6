// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include "hyperex/anatomy/fold_profile.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

using anatomy::Groove;
using anatomy::groove_of;

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
