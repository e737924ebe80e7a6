// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {

/// Whether a file gives the thickness anywhere.
bool is_painted(const TissueMeshOptions& options);

/// Reads these files as skin_depth() will, and returns notes on how they were matched with the
/// scan. Throws InputError where they cannot be used.
std::vector<Note> notes_on_depth_files(const TissueMeshOptions& options, const TriMesh& scan);

/// Requested thickness at points, m, without the values of files: constant, or interpolated from
/// depths at landmarks (depth_field).
Eigen::VectorXd unpainted_depth(const Points& points, const io::Landmarks& landmarks,
                                const TissueMeshOptions& options);

/// Requested thickness at each vertex of `mesh.skin`, m: unpainted_depth(), replaced by
/// depth_per_vertex where that has values, then changed by one region after the other, d <- d + w
/// (depth - d), where w is the region's share at the vertex. `mesh` needs its skin
/// (TissueMeshBuilder::with_skin), not its volume. Throws InputError.
Eigen::VectorXd skin_depth(const TissueMesh& mesh, const io::Landmarks& landmarks,
                           const TissueMeshOptions& options);

}  // namespace hyperex::tissue
