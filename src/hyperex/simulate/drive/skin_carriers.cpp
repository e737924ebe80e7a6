// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/skin_carriers.hpp"

#include <algorithm>

namespace hyperex::simulate {

std::vector<SkinCarrier> skin_carriers(const tissue::TissueMesh& mesh,
                                       const std::vector<tissue::RimVertex>& rim,
                                       const MeasuredRegion& region,
                                       const std::vector<int>& vertices) {
  std::vector<SkinCarrier> all(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const int v = vertices[i];
    const double physical = 1 - region.share[std::size_t(v)];
    if (physical <= 0) continue;
    const auto on_rim =
        std::lower_bound(rim.begin(), rim.end(), v,
                         [](const tissue::RimVertex& r, int vertex) { return r.vertex < vertex; });
    if (on_rim != rim.end() && on_rim->vertex == v) {
      for (std::size_t k = 0; k < on_rim->node.size(); ++k)
        all[i].emplace_back(on_rim->node[k], physical * on_rim->weight[k]);
      continue;
    }
    const tissue::Anchor& anchor = mesh.anchors[std::size_t(v)];
    for (int k = 0; k < 3; ++k)
      if (anchor.weight[k] != 0)
        all[i].emplace_back(anchor.node[std::size_t(k)], physical * anchor.weight[k]);
  }
  return all;
}

}  // namespace hyperex::simulate
