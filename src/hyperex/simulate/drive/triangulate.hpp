// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::simulate {

/// Constrained Delaunay triangles over tracked points seen from the front, counter-clockwise from
/// outside. The contours of the eyes and of the outer and inner lips (by their iBUG-68 names) are
/// edges. No triangle lies inside an eye or between the lips. Names distinguish the lips where they
/// touch.
Triangles triangulate_points(const std::vector<std::string>& names, const Points& rest,
                             const face::FaceFrame& frame);

}  // namespace hyperex::simulate
