// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::simulate {

/// Triangles over tracked points seen from the front (constrained Delaunay), counter-clockwise from
/// outside. The contours of eyes, outer and inner lips by their iBUG-68 names are kept as edges and
/// nothing is put inside an eye or between the lips; lips that touch are told apart by name, not by
/// place.
Triangles triangulate_points(const std::vector<std::string>& names, const Points& rest,
                             const face::FaceFrame& frame);

}  // namespace hyperex::simulate
