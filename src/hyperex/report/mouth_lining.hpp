// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the room: the lining of lips and cheeks behind the opening of the mouth.
#include <functional>

#include "hyperex/anatomy/eyeballs.hpp"
#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/report/face_backing.hpp"

namespace hyperex::report {

/// Distance at rest between the lining of the mouth and crowns, gums and tongue.
inline constexpr double kLiningClearance_m = 2.8e-3;

/// Gives the opening of a mouth (its loop and direction are set) a pocket that holds both rows of
/// teeth. From each vertex of the lips' edge, the lining takes the shortest path around the rows:
/// from the upper lip over the upper row, from the lower lip under the lower row. It keeps the
/// distance kLiningClearance_m from the convex hull of each cross-section of the rows, and closes 8
/// mm behind them. It thus forms the inner side of the lips, the vestibule, the cheeks, the roof
/// and the floor of the mouth. If `teeth` is null, average rows behind the lips are used. `room`:
/// the depth available for a pocket (m) at a height relative to the middle of the edge. The lining
/// ends at that depth, and cuts the rows if the scan is not deep enough. Vertices that would lie in
/// front of the skin are moved to 1.5 mm behind it. Motion: the inner side of the lips follows
/// their edge, with a share that decreases with depth. Farther back, the upper part does not move
/// and the lower part moves with the jaw, as the rows do. Colour: mucosa at the edge, darker with
/// depth.
void line_mouth(Opening& opening, const TriMesh& skin, const anatomy::FaceCorners& corners,
                const anatomy::Teeth* teeth, const std::function<double(double)>& room);

}  // namespace hyperex::report
