// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// For each vertex, the first vertex at exactly the same place: the vertex itself where it is
/// alone. Files with sharp edges or several normals at a vertex repeat it once per triangle.
std::vector<int> first_at_same_place(const Points& points);

/// A copy of a scan's mesh with its defects repaired, and a report on the repairs.
struct CleanMesh {
  TriMesh mesh;  ///< manifold, consistently oriented, one component
  /// For each vertex, the vertex of the given mesh that it corresponds to.
  std::vector<int> source_vertex;
  std::vector<int> source_triangle;  ///< for each triangle, the triangle of the given mesh
  /// One sentence for each kind of repair; empty if none was needed.
  std::vector<std::string> notes;
};

struct CleanOptions {
  /// Components with less than this share of the total area are dropped as islands. A second
  /// component that is larger is an error.
  double island_area_share = 0.2;
  /// Set to false for a surface that was cut on purpose: the two rims of a cut coincide and would
  /// be joined.
  bool join_duplicates = true;
};

/// Joins duplicate vertices; drops degenerate triangles, duplicate triangles and unused vertices;
/// resolves edges with more than two triangles and pinched vertices; keeps the largest component
/// and drops the islands. Throws std::invalid_argument (not InputError, as no file is known here)
/// if another component is too large to be an island, or if nothing is left.
CleanMesh clean_mesh(const TriMesh& mesh, const CleanOptions& options = {});

/// The mesh without the triangles for which `drop` is set, cleaned again. Vertices at the same
/// place are not joined, so that a cut stays open.
TriMesh without_triangles(const TriMesh& mesh, const std::vector<char>& drop);

}  // namespace hyperex
