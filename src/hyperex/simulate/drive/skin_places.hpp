// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/matching.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// Where named places (n x 3, scan frame, m) lie on the skin: the closest point of the closest
/// triangle of mesh.skin, a lip's point on that lip. A place that lies off the skin moves as that
/// closest point does.
std::vector<Match> skin_places(const tissue::TissueMesh& mesh,
                               const std::vector<std::string>& names, const Points& places);

/// Carriers of skin places: displacement of the place = row * displacement of the outer nodes,
/// through the anchors of its triangle's corners. |places| x |outer nodes|; each row sums to 1.
using CarrierMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
CarrierMatrix carriers(const tissue::TissueMesh& mesh, const std::vector<Match>& places);

}  // namespace hyperex::simulate
