// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>
#include <vector>

#include "hyperex/simulate/drive/skin_measured.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// How a vertex of the skin follows the tissue: outer nodes with their weights.
using SkinCarrier = std::vector<std::pair<int, double>>;

/// Of some vertices of the skin, in their order: what Readout::skin() makes of the nodes'
/// displacements, as weights; where the skin is measured it follows no node. `rim`: rising.
std::vector<SkinCarrier> skin_carriers(const tissue::TissueMesh& mesh,
                                       const std::vector<tissue::RimVertex>& rim,
                                       const MeasuredRegion& region,
                                       const std::vector<int>& vertices);

}  // namespace hyperex::simulate
