// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/fem/form/dilatation_groups.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

/// Throws InputError naming the first tetrahedron with a corner that is no node.
void check_corners(Eigen::Index node_count, const Tetrahedra& tets);
/// The same; also throws InputError if there is no tetrahedron.
void check_mesh(const Points& nodes, const Tetrahedra& tets);
/// Throws InputError if a group contains the number of no existing tetrahedron, or if a tetrahedron
/// is in no group.
void check_groups(const DilatationGroups& groups, Eigen::Index tet_count);

}  // namespace hyperex::fem
