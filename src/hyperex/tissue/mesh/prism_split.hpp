// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// A corner of a prism: of its triangle (0 to 2), on the upper level or the one below it.
struct PrismCorner {
  int corner, below;
};
using PrismTets = std::array<std::array<PrismCorner, 4>, 3>;

/// The three tetrahedra of a prism. The diagonal of a side face runs from the top at the corner of
/// lower rank to the bottom at the other, so that neighbouring prisms agree wherever all ranks
/// differ. `rank`: of the triangle's three corners.
PrismTets split_prism(const std::array<double, 3>& rank);

/// Ranks of the vertices (|V|) for one layer of prisms between two levels. The ranks are the
/// vertices' numbers, except where these give a flat tetrahedron (3 inradius / circumradius below
/// 0.15) and other diagonals give better shapes. This avoids tetrahedra with a height of a tenth of
/// a millimetre in folds without moving a node. If all tetrahedra have positive volume with the
/// vertices' numbers as ranks, which is required, they also have it with the returned ranks. `top`,
/// `bottom`: |V| x 3, m.
std::vector<double> prism_ranks(const Triangles& triangles, const Points& top,
                                const Points& bottom);

/// 3 inradius / circumradius of a tetrahedron: 1 for the regular one; negative where inverted.
double radius_ratio(const std::array<Vec3, 4>& corners);

}  // namespace hyperex::tissue
