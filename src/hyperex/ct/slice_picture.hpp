// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/ct/volume.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::ct {

/// A plane through the head, seen along its normal: x right, y up in the picture.
struct SlicePlane {
  Vec3 middle = Vec3::Zero();
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY();  ///< unit length
  double width_m = 0.2, height_m = 0.2;
};

struct Contour {
  const TriMesh& mesh;
  render::Colour colour;
};

/// The values on the plane in greys from -500 (black) to 1200 HU (white), which show bone, with the
/// lines in which the plane cuts the surfaces. Without values it is black.
render::Image slice_picture(const Volume& volume, const SlicePlane& plane,
                            const std::vector<Contour>& contours, double pixels_per_m);

}  // namespace hyperex::ct
