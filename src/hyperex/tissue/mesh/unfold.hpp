// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// For each vertex the direction from which all triangles around it are seen from outside, as far
/// as there is one (the normal turned towards the worst triangle until none is worse), and the
/// least cosine between that direction and their normals: not above 0 where the surface is folded.
struct Visibility {
  Points direction;       ///< |V| x 3, unit
  Eigen::VectorXd least;  ///< |V|
};
Visibility visibility_of(const TriMesh& mesh);
/// The same after the flagged vertices have `moved`: updates only them and their neighbours.
/// `fans`: vertex_triangles of the mesh.
void update_visibility(const TriMesh& mesh, const std::vector<char>& moved,
                       const std::vector<std::vector<int>>& fans, Visibility& visibility);

/// Makes a surface fit to be thickened: smooths it around folded vertices (visibility below
/// `least`), and where that does not help drops the triangles around them. Adds notes on what it
/// did.
TriMesh unfold(const TriMesh& mesh, std::vector<Note>& notes, double least = 0.3);

}  // namespace hyperex::tissue
