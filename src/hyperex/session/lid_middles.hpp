// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include "hyperex/geometry/types.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::session {

/// The points that add_lid_middles() adds.
inline constexpr std::array kLidMiddles = {"lid_middle_upper_R", "lid_middle_lower_R",
                                           "lid_middle_upper_L", "lid_middle_lower_L"};

/// Adds points in the middle of the lids' edges to the motion of a face model. Of each lid it has
/// two points, on either side of the middle. An eye that is much wider between them than at them
/// would stay open there in a blink: on subject D by 3.5 of 9.2 mm. The added points move as the
/// mean of the two, times the ratio of the apertures. They are added where the ratio of
/// an eye is 1.25 or more; to both eyes or to none, so that each has a counterpart. None are added
/// where the edges of lids are not seen (tracking::lid_edges_at) or a ratio is 2 or more.
/// `scan_from_face`: its columns are the face's left, up and front directions.
void add_lid_middles(simulate::AlignedMotion& aligned, const TriMesh& scan,
                     const Eigen::Matrix3d& scan_from_face);

}  // namespace hyperex::session
