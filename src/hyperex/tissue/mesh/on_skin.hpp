// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/tissue/mesh/side_tree.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {

/// The mesh with the skin as it was before thinning, for files that refer to the scan's own
/// vertices.
TissueMesh with_full_skin(const TissueMesh& mesh);

/// Closest points on the skin. Near the mouth, they lie on the same lip as the query point.
SideTree skin_tree(const TissueMesh& mesh, const io::Landmarks& landmarks);

/// The scan from which the skin was made. Files with one row per vertex refer to its vertices.
TriMesh scan_of(const TissueMesh& mesh);

/// Values at the scan's vertices, extended to the vertices that the cut added by interpolation
/// along edges. If an edge joined the lips, each end of the cut takes the value of its own lip, so
/// that values do not spread to the other lip.
Eigen::VectorXd on_skin(const TissueMesh& mesh, const Eigen::VectorXd& of_scan);

}  // namespace hyperex::tissue
