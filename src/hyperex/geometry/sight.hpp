// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// For each of the given vertices, the share (0 to 1) of `directions` in which the surface itself
/// is hit within `reach_m`. `directions`: unit vectors pointing outwards, |D| x 3. Rays start 0.1
/// mm outside the surface, along the vertex normal.
std::vector<double> blocked_shares(const TriMesh& mesh, const std::vector<int>& vertices,
                                   const Points& directions, double reach_m);

}  // namespace hyperex
