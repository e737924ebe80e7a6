// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>
#include <vector>

#include "hyperex/simulate/drive/skin_measured.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// The outer nodes that a vertex of the skin follows, with their weights.
using SkinCarrier = std::vector<std::pair<int, double>>;

/// The carriers of some vertices of the skin, in their order: Readout::skin() as weights of the
/// nodes. Skin that is measured follows no node. `rim`: rising by vertex.
std::vector<SkinCarrier> skin_carriers(const tissue::TissueMesh& mesh,
                                       const std::vector<tissue::RimVertex>& rim,
                                       const MeasuredRegion& region,
                                       const std::vector<int>& vertices);

}  // namespace hyperex::simulate
