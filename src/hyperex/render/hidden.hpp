// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::render {

/// Which of the points are hidden from an eye at the origin: a triangle of `mesh` lies on the line
/// of sight and is nearer by more than `bias_m`, measured along z. Mesh and points are in the eye's
/// frame, with z > 0 the distance. One bool per point.
std::vector<bool> hidden_from_origin(const TriMesh& mesh, const Points& points,
                                     double bias_m = 0.002);

}  // namespace hyperex::render
