// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Of each of the given vertices the share (0 to 1) of `directions` (unit, outwards, |D| x 3) in
/// which the surface itself stands in the way within `reach_m`. Rays begin 0.1 mm outside, along
/// the vertex normal.
std::vector<double> blocked_shares(const TriMesh& mesh, const std::vector<int>& vertices,
                                   const Points& directions, double reach_m);

}  // namespace hyperex
