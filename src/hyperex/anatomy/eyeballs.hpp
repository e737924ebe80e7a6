// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// The corners of the eyes and of the mouth: metres, the right one first.
struct FaceCorners {
  std::array<Vec3, 2> outer;
  std::array<std::optional<Vec3>, 2> inner;
  std::array<Vec3, 2> mouth;
  Vec3 forward;  ///< unit length: the direction in which an upright head looks
};

/// From the iBUG points or their anatomical names; nothing without the outer corners of the eyes
/// and those of the mouth.
std::optional<FaceCorners> face_corners(const io::Landmarks& landmarks);

/// A sphere that looks along `gaze` (unit length).
struct Eyeball {
  Vec3 centre, gaze;
  double radius_m = 0;
};

/// Right and left, behind `skin` (vertices at rest, metres); none without inner corners. The radius
/// is 0.4 of the distance of the eye's corners (an adult's is 12 mm, behind an opening of some 30
/// mm). The ball is as far forward as a distance of 0.4 mm from all vertices of the lids allows.
/// Its front is at most 2.5 mm before, and at most 8 mm behind, a sixth of the corners' distance in
/// front of the line between them. Where the skin beside an eye would keep it back, it makes way:
/// both balls shift by up to 1.5 mm towards the nose and 1.5 mm up, if each millimetre brings them
/// forward by 0.3 (to the nose) or 0.4 mm (up) or more. So no single vertex decides.
std::vector<Eyeball> eyeballs_behind(const Points& skin, const FaceCorners& corners);

}  // namespace hyperex::anatomy
