// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

struct ThinOptions {
  double edge_m = 1e-3;       ///< edges up to this length may be collapsed
  double tolerance_m = 1e-4;  ///< greatest distance of a removed vertex from the thinned surface
  /// If more vertices than this remain (a noisy scan), the tolerance is doubled, up to twice.
  std::size_t enough_vertices = 250000;
};

/// A point on a mesh as a weighted mean of three vertices.
struct MeshPlace {
  std::array<int, 3> vertex{};
  Vec3 weight = Vec3::UnitX();
};

/// A mesh with fewer vertices. Each of them is a vertex of the given mesh.
struct ThinMesh {
  TriMesh mesh;
  std::vector<int> source_vertex;  ///< for each vertex, the vertex of the given mesh
  /// For each triangle, the given triangle from which it resulted.
  std::vector<int> source_triangle;
  /// For each vertex of the given mesh, the closest point of the thinned surface. It is searched
  /// only near the vertex into which it was merged, so that it lies on the same side of a slit.
  std::vector<MeshPlace> places;
  double greatest_distance_m = 0;  ///< greatest distance of a given vertex from its place
};

/// Collapses edges, short ones first, each onto one of its ends. A collapse is rejected if it would
/// change the topology, rotate a triangle by more than 45 degrees, create a sliver or an edge
/// longer than 1.6 edge_m, or leave a removed vertex farther than the tolerance from the new
/// surface. Borders and vertices with `held` set (empty: none) are not changed. `mesh` must be
/// manifold and oriented (clean_mesh). The same input always gives the same output.
ThinMesh thin_mesh(const TriMesh& mesh, const ThinOptions& options,
                   const std::vector<char>& held = {});

}  // namespace hyperex
