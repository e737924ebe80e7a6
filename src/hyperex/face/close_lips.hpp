// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::face {

/// Closes parted lips to a gap of 0.2 mm, as lips are at rest. `points`: metres, +x the subject's
/// left, +y up. `contour`: the vertices of the lips' inner edge, the upper lip from the subject's
/// right corner to the left one, then the lower lip back; the two lips have equally many.
///
/// Seven tenths of the way are the lower lip's, which follows the jaw. What lies off the edges goes
/// along by a Gaussian of its distance from them, of 18 mm below and 10 mm above, and takes the
/// mean way of a part of the edge as wide as it is far. So the skin beside the corners moves a
/// little too.
void close_lips(Points& points, const std::vector<int>& contour);

}  // namespace hyperex::face
