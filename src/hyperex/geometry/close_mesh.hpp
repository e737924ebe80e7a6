// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Report of close_mesh().
struct Closing {
  int borders = 0;       ///< number of borders closed
  double longest_m = 0;  ///< length of the longest of them
  std::string why_not;   ///< why it failed; empty if the mesh is now watertight
};

/// Makes a surface watertight with outward triangles. Each border is filled (fill_hole). If this
/// would put a third triangle on an edge, a ring of triangles, half an edge wide, is first added
/// along the border. If the enclosed volume is negative, all triangles are reversed. If the
/// triangles are not consistently oriented, the mesh is first cleaned (clean_mesh), which drops
/// small components. Lengths in metres. Throws nothing but std::bad_alloc. If it fails, the mesh is
/// left partly closed.
Closing close_mesh(TriMesh& mesh);

}  // namespace hyperex
