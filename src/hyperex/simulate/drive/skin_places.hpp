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

/// On which lip a vertex lies, as match() takes it: 1 upper, -1 lower, 0 within 2 mm of both.
/// `upper_margin`: TissueMesh::upper_margin or skin_upper_margin.
std::vector<int> lip_sides(const std::vector<double>& upper_margin);

/// The weights with which places on the skin follow the outer nodes, through the anchors of their
/// triangles' corners: displacement of a place = its row * displacement of the outer nodes.
/// |places| x |outer nodes|; each row sums to 1.
using CarrierMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
CarrierMatrix carriers(const tissue::TissueMesh& mesh, const std::vector<Match>& places);

/// Displacements of places, 3 |rows of `weights`| x n, under those of nodes. `nodal`: at least 3
/// |columns of `weights`| x n, those of the outer nodes first.
Eigen::MatrixXd at_places(const CarrierMatrix& weights, const Eigen::MatrixXd& nodal);

}  // namespace hyperex::simulate
