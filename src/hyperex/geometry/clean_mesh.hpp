// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// A working copy of a scan without its faults, and what was done to get it.
struct CleanMesh {
  TriMesh mesh;                      ///< manifold, consistently oriented, one component
  std::vector<int> source_vertex;    ///< of each vertex, the vertex of the given mesh it stands for
  std::vector<int> source_triangle;  ///< of each triangle, the same
  std::vector<std::string> notes;  ///< one sentence for each thing that was mended; empty if sound
};

struct CleanOptions {
  /// Components with less than this share of the whole area are islands and are dropped.
  double island_area_share = 0.2;
  /// False for a surface that was cut on purpose: the two rims of a cut lie at the same place.
  bool join_duplicates = true;
};

/// Joins duplicate vertices, drops degenerate, duplicate and unused ones, resolves edges of more
/// than two triangles and pinched vertices, keeps the large components (only the largest, where
/// several are large). Throws InputError-free std::invalid_argument where nothing is left.
CleanMesh clean_mesh(const TriMesh& mesh, const CleanOptions& options = {});

/// The mesh without the triangles for which `drop` is set, cleaned again without joining vertices
/// at one place (a cut stays open).
TriMesh without_triangles(const TriMesh& mesh, const std::vector<char>& drop);

}  // namespace hyperex
