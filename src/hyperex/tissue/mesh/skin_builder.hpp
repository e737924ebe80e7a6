// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to this room: prepares the scan's skin for the tissue's mesh.
#include <string>
#include <vector>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/cut_surface.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {

/// The cleaned scan with the cuts that were requested, and the same cuts in the scan as given.
class SkinBuilder {
 public:
  /// Fills `out.skin` and the members that depend on it. All arguments must outlive this object.
  /// Throws InputError.
  SkinBuilder(const TriMesh& scan, const io::Landmarks& landmarks, const std::string& source,
              TissueMesh& out);

  void cut(LipCut mode);

  /// If the scan has more than thinned_above_vertices vertices, `out.skin` becomes a thinned
  /// working copy, and `out.full` the original skin. `held`: the scan's vertices to keep.
  void thin(double element_size_m, const std::vector<char>& held);

  /// The working copy.
  const TriMesh& mesh() const { return clean_.mesh; }

  /// Transfers values from the working copy's vertices to those of the skin; 0 where there is no
  /// value.
  std::vector<double> on_skin(const std::vector<double>& values) const;

 private:
  void apply(const CutSurface& cut);
  int scan_corner(int vertex, int clean_triangle, int scan_triangle) const;
  int skin_vertex(int vertex) const;
  Eigen::Index skin_row(Eigen::Index clean_triangle) const;
  std::vector<MeshPlace> places_of_skin(const ThinMesh& thin) const;

  const TriMesh& scan_;
  const io::Landmarks& landmarks_;
  std::string source_;
  TissueMesh& out_;
  std::vector<int> first_;  // of each vertex of the scan, the first one at its place
  CleanMesh clean_;
  Eigen::Index uncut_triangles_ = 0;  // of the working copy, before the cut
};

}  // namespace hyperex::tissue
