// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// What close_mesh() did.
struct Closing {
  int borders = 0;       ///< closed
  double longest_m = 0;  ///< of them
  std::string why_not;   ///< empty: the mesh is watertight now
};

/// Makes a surface watertight, its triangles outward: fills each border (fill_hole), behind a
/// ring of half an edge's width where edges would meet three triangles else, and turns all
/// triangles round where they enclose a negative volume. A surface whose edges are not of two
/// triangles, oriented alike, is cleaned first (clean_mesh), which leaves its largest part.
/// Metres. Throws nothing but std::bad_alloc; where it fails the mesh is left half closed.
Closing close_mesh(TriMesh& mesh);

}  // namespace hyperex
