// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::face {

/// Closes parted lips to a gap of 0.2 mm, as lips are at rest. `points`: metres, +x the subject's
/// left, +y up. `contour`: the vertices of the lips' inner edge, the upper lip from the subject's
/// right corner to the left one, then the lower lip back; the two lips have equally many.
///
/// The lower lip, which follows the jaw, moves by seven tenths of the gap, the upper lip by the
/// rest. Off the edges the displacement decreases as a Gaussian of the distance from them, with 1
/// sigma of 18 mm below and 10 mm above. It is averaged along the edge over a width that grows with
/// that distance. So the skin beside the corners moves a little too.
void close_lips(Points& points, const std::vector<int>& contour);

}  // namespace hyperex::face
