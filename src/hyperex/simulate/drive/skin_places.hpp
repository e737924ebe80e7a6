// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/matching.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// The closest points of mesh.skin to named places (n x 3, scan frame, m). A point of a lip is
/// matched to that lip. A place off the skin moves as its closest point does.
std::vector<Match> skin_places(const tissue::TissueMesh& mesh,
                               const std::vector<std::string>& names, const Points& places);

/// The weights with which places on the skin follow the outer nodes, through the anchors of their
/// triangles' corners: displacement of a place = its row * displacement of the outer nodes.
/// |places| x |outer nodes|; each row sums to 1.
using CarrierMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
CarrierMatrix carriers(const tissue::TissueMesh& mesh, const std::vector<Match>& places);

}  // namespace hyperex::simulate
