// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::render {

/// Which of the points an eye at the origin cannot see because a triangle of `mesh` lies on the way
/// and more than `bias_m` nearer, along z. Everything in the eye's frame with z > 0 the distance.
/// One bool a point.
std::vector<bool> hidden_from_origin(const TriMesh& mesh, const Points& points,
                                     double bias_m = 0.002);

}  // namespace hyperex::render
