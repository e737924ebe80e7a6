// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

struct ThinOptions {
  double edge_m = 1e-3;       ///< edges up to this length are collapsed
  double tolerance_m = 1e-4;  ///< how far a removed vertex may end from the thinned surface
  /// The tolerance is doubled, up to twice, where more vertices than this are left (a noisy scan).
  std::size_t enough_vertices = 250000;
};

/// A point of a mesh: shares of three of its vertices.
struct MeshPlace {
  std::array<int, 3> vertex{};
  Vec3 weight = Vec3::UnitX();
};

/// A mesh with fewer vertices, each of them one of the given mesh's own.
struct ThinMesh {
  TriMesh mesh;
  std::vector<int> source_vertex;    ///< of each vertex, the given mesh's that it is
  std::vector<int> source_triangle;  ///< of each triangle, the given one whose corners moved to it
  /// Of each vertex of the given mesh the nearest point of the thinned surface; searched where its
  /// edges were collapsed to, so that it is on the same side of a slit.
  std::vector<MeshPlace> places;
  double greatest_distance_m = 0;  ///< of the given vertices from there
};

/// Collapses edges, the short ones first, each onto one of its ends. A collapse is left out where
/// it would change the topology, turn a triangle by more than 45 degrees, make a sliver or an edge
/// longer than 1.6 edge_m, or leave a vertex that was removed there farther than the tolerance from
/// the new surface. Borders stay as they are, and so do the vertices with `held` set (empty: none).
/// `mesh` must be manifold and oriented (clean_mesh). The same input gives the same output.
ThinMesh thin_mesh(const TriMesh& mesh, const ThinOptions& options,
                   const std::vector<char>& held = {});

}  // namespace hyperex
