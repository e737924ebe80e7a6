// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/anatomy/bones.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// A layer of soft tissue between the skin and an inner surface: prisms over the triangles of the
/// outer surface, each cut into three tetrahedra.
struct VolumeMesh {
  Points nodes;  ///< level by level: node = level * surface_nodes + vertex; level 0 is the skin
  /// Positive volume; three to a prism. Prisms come by the triangles of `outer`, those under one
  /// triangle from the skin inwards.
  Tetrahedra tets;
  TriMesh outer;                ///< the skin side (vertices = nodes of level 0)
  int layers = 0;               ///< of prisms; levels of nodes are layers + 1
  Eigen::VectorXd thickness_m;  ///< per outer vertex, as built
  std::vector<Note> notes;

  Eigen::Index surface_nodes() const { return outer.points.rows(); }
  int inner_node(int vertex) const { return static_cast<int>(layers * surface_nodes()) + vertex; }
};

/// No layer of positive volume fits under some triangles.
struct FoldedSurface : NumericalError {
  FoldedSurface(const std::string& message, std::vector<int> where)
      : NumericalError(message), triangles(std::move(where)) {}
  std::vector<int> triangles;  ///< of the outer surface
};

struct VolumeMeshOptions {
  int layers = 2;
  /// Least volume of a tetrahedron relative to the ideal one in its prism (area x height / 3).
  /// Larger values are tried first.
  double least_volume_share = 0.01;
  /// The layer ends on these bones where bone_depths() finds them; null: none.
  const anatomy::Bones* bones = nullptr;
};

/// `outer`: manifold, oriented outwards. `thickness_m`: requested thickness per outer vertex, > 0.
/// Where the layer would fold (concave or thin places), the direction is smoothed. If that is not
/// enough, the thickness is reduced until every tetrahedron has positive volume. Notes state how
/// often this was done. Throws FoldedSurface where no positive layer exists (a folded outer
/// surface).
VolumeMesh build_volume_mesh(const TriMesh& outer, const Eigen::VectorXd& thickness_m,
                             const VolumeMeshOptions& options = {});

/// Quality of a tetrahedral mesh.
struct MeshQuality {
  double least_volume_mm3 = 0, mean_volume_mm3 = 0, total_volume_mm3 = 0;
  double least_dihedral_deg = 0, greatest_dihedral_deg = 0;
  /// Share of tetrahedra whose least dihedral angle lies in [0,5), [5,10), [10,20), [20,30), [30,
  /// 90] degrees.
  std::vector<double> least_dihedral_shares;
  double worst_radius_ratio = 0;  ///< least 3 inradius / circumradius; 1 is regular
};
inline constexpr double dihedral_bounds_deg[] = {0, 5, 10, 20, 30, 90};
MeshQuality quality_of(const Points& nodes, const Tetrahedra& tets);

/// The closed surface of the layer of tissue: the skin, the inner surface (with reversed
/// orientation), and the strips between them along the borders. Its points are those of the skin,
/// followed by those of the inner surface.
TriMesh boundary_of(const VolumeMesh& volume);

}  // namespace hyperex::tissue
