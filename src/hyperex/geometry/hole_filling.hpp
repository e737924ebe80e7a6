// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Fills the hole inside a border loop (boundary_loops) of an oriented mesh with triangles between
/// the vertices of the loop (CGAL's hole filling, which minimises area and dihedral angle). Returns
/// false, with the mesh unchanged, if there is no such filling.
bool fill_hole(TriMesh& mesh, const std::vector<int>& loop);

}  // namespace hyperex
