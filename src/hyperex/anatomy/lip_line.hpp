// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/geometry/types.hpp"

namespace hyperex::anatomy {

/// The line where the closed lips meet, as seen from in front.
struct LipLine {
  Points points;  ///< from the subject's right corner to the left, on the surface, metres
  double crease_m =
      0;  ///< mean over the line: how far the surface 1.5 mm above and below stands out
};

/// Finds the deepest crease from corner to corner. The scan's foremost surface is represented as
/// heights over the face's frontal plane, so that inner sides of the lips are hidden. The line is
/// the path with the largest second differences in vertical direction, found by dynamic
/// programming. `guess`: a polyline from the right corner to the left; the search is restricted to
/// 8 mm from it, less towards the ends, which are kept. `scan_from_face`: rotation whose columns
/// are the subject's left, up and forward in the scan's frame. Returns nothing if there is no clear
/// crease.
std::optional<LipLine> find_lip_line(const TriMesh& scan, const Points& guess,
                                     const Eigen::Matrix3d& scan_from_face);

}  // namespace hyperex::anatomy
