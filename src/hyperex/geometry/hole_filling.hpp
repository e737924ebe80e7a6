// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Closes the hole inside a border loop (boundary_loops) of an oriented mesh with triangles over
/// its own vertices (CGAL's hole filling of least area and angle). False, and nothing changed,
/// where it finds none.
bool fill_hole(TriMesh& mesh, const std::vector<int>& loop);

}  // namespace hyperex
