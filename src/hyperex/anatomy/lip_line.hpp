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

/// Finds it as the deepest crease from corner to corner: the scan's foremost surface as heights
/// over the face's frontal plane (so that the lips' inner sides, where the scan has them, are
/// hidden), and through them the path of largest second difference upwards, by dynamic programming.
/// `guess`: a polyline from the right corner to the left near which it is sought (within 8 mm,
/// nearer towards the ends, which are kept); `scan_from_face`: rotation whose columns are the
/// subject's left, up and forward in the scan's frame. Nothing where no clear crease runs there.
std::optional<LipLine> find_lip_line(const TriMesh& scan, const Points& guess,
                                     const Eigen::Matrix3d& scan_from_face);

}  // namespace hyperex::anatomy
