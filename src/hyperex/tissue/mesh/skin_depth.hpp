// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {

/// Whether files say how thick the tissue is somewhere.
bool is_painted(const TissueMeshOptions& options);

/// Reads them as skin_depth() will: what was done to match them with the scan. Throws InputError
/// where they cannot serve.
std::vector<Note> notes_on_depth_files(const TissueMeshOptions& options, const TriMesh& scan);

/// Wanted thickness at points, m, without what files say: the same everywhere, or depths at
/// landmarks, interpolated (depth_field).
Eigen::VectorXd unpainted_depth(const Points& points, const io::Landmarks& landmarks,
                                const TissueMeshOptions& options);

/// Wanted thickness at each vertex of `mesh.skin`, m: unpainted_depth(); in its place that of
/// depth_per_vertex where it gives any; then regions in turn, d <- d + w (depth - d), w the
/// region's share at the vertex. Of `mesh` the skin and what belongs to it must be known. Throws
/// InputError.
Eigen::VectorXd skin_depth(const TissueMesh& mesh, const io::Landmarks& landmarks,
                           const TissueMeshOptions& options);

}  // namespace hyperex::tissue
