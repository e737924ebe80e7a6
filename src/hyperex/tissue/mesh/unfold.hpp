// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// For each vertex, a direction from which all triangles around it are seen from outside, if there
/// is one. It is found by turning the vertex normal towards the triangle with the least cosine as
/// long as that cosine grows. `least` is that cosine; it is 0 or negative where the surface is
/// folded.
struct Visibility {
  Points direction;       ///< |V| x 3, unit
  Eigen::VectorXd least;  ///< |V|
};
Visibility visibility_of(const TriMesh& mesh);
/// The same after the flagged vertices have `moved`: updates only them and their neighbours.
/// `fans`: vertex_triangles of the mesh.
void update_visibility(const TriMesh& mesh, const std::vector<char>& moved,
                       const std::vector<std::vector<int>>& fans, Visibility& visibility);

/// Removes folds, so that a layer fits under the surface. Smooths the surface around folded
/// vertices (visibility below `least`) and, if that does not help, removes the triangles around
/// them. Adds notes on both.
TriMesh unfold(const TriMesh& mesh, std::vector<Note>& notes, double least = 0.3);

}  // namespace hyperex::tissue
