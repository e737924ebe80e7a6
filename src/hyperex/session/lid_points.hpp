// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include "hyperex/geometry/types.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::session {

/// The points that add_lid_points() adds.
inline constexpr std::array kLidPoints = {
    "lid_middle_upper_R", "lid_middle_lower_R", "lid_middle_upper_L", "lid_middle_lower_L",
    "lid_inner_upper_R",  "lid_inner_lower_R",  "lid_inner_upper_L",  "lid_inner_lower_L"};

/// Adds points on the lids' edges to the motion of a face model, where a blink by its own points
/// would leave an eye open. Of each lid it has two points, on either side of the middle, and the
/// corners of the eye, which stay.
///
/// In the middle: an eye that is much wider there than at the points stays open. On subject D it
/// did by 3.5 of 9.2 mm. The added points move as the mean of the two, times the ratio of the
/// apertures, where that of an eye is 1.25 or more.
///
/// At the inner corner, half-way to the points next to it: lids that meet farther in than the
/// corner's landmark stay open beside it, since the skin there moves half as far as at the points.
/// The added points move as those of the lids next to the corner, times the ratio of the apertures,
/// where that of an eye is 0.65 or more (the skin's own is about 0.5).
///
/// Each kind is added to both eyes or to none, so that each point has a counterpart. None are added
/// where the edges of lids are not seen (tracking::lid_edges_at) or a ratio is 2 or more.
/// `scan_from_face`: its columns are the face's left, up and front directions.
void add_lid_points(simulate::AlignedMotion& aligned, const TriMesh& scan,
                    const Eigen::Matrix3d& scan_from_face);

}  // namespace hyperex::session
