// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/tissue/mesh/side_tree.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {

/// The mesh with the skin as it was before thinning, for what names the scan's own vertices.
TissueMesh with_full_skin(const TissueMesh& mesh);

/// Closest points on the skin, near the mouth those of one's own lip.
SideTree skin_tree(const TissueMesh& mesh, const io::Landmarks& landmarks);

/// The scan that the skin was cut from: what files with a row per vertex name.
TriMesh scan_of(const TissueMesh& mesh);

/// Values of the scan's vertices, and between them those of the vertices that the cut added; where
/// an edge joined the lips, each end of the cut has the value of its own lip: what holds for one
/// does not run over to the other.
Eigen::VectorXd on_skin(const TissueMesh& mesh, const Eigen::VectorXd& of_scan);

}  // namespace hyperex::tissue
