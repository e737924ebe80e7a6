// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// 3 inradius / circumradius of a tetrahedron: 1 is regular, not above 0 inverted, NaN a point.
double radius_ratio(const Points& nodes, const Tetrahedra& tets, Eigen::Index tet);

/// What plump_up() did.
struct Plumped {
  int nodes = 0;  ///< moved
  double greatest_move_m = 0;
};

/// Makes flat tetrahedra plumper. Nodes below the first `held` of tetrahedra whose radius ratio
/// lies below `least` move to a local minimum of sum (1 / q)^4 over the tetrahedra around them,
/// where
///     q = 12 (3 V)^(2/3) / (sum of squared edges)
/// is the mean ratio (1: regular; Liu and Joe 1994). No tetrahedron around them loses its positive
/// volume. Nodes are visited in order, so the same input gives the same output.
Plumped plump_up(Points& nodes, const Tetrahedra& tets, Eigen::Index held, double least);

}  // namespace hyperex::tissue
