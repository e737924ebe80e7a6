// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/mesh_entry.hpp"

#include <algorithm>

#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

void check_corners(Eigen::Index node_count, const Tetrahedra& tets) {
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    for (int a = 0; a < 4; ++a)
      require(tets(t, a) >= 0 && tets(t, a) < node_count,
              "tetrahedron {} has the corner {}: expected a node from 0 to {}", t, tets(t, a),
              node_count - 1);
}

void check_mesh(const Points& nodes, const Tetrahedra& tets) {
  require(tets.rows() > 0, "the mesh has no tetrahedra: expected at least one");
  check_corners(nodes.rows(), tets);
}

void check_groups(const DilatationGroups& groups, Eigen::Index tet_count) {
  const Lists& lists = groups.tets;
  check_positive("DilatationGroups::kept + 1", groups.kept + 1);
  require(!lists.start.empty() && lists.start.front() == 0 &&
              std::is_sorted(lists.start.begin(), lists.start.end()) &&
              lists.start.back() == static_cast<int>(lists.item.size()),
          "DilatationGroups::tets: where its lists start does not rise from 0 to {}",
          lists.item.size());
  if (lists.size() == 0) return;
  std::vector<char> named(static_cast<std::size_t>(tet_count), 0);
  for (int g = 0; g < lists.size(); ++g)
    for (const int t : lists[g]) {
      require(t >= 0 && t < tet_count, "dilatation group {} names tetrahedron {}: expected 0 to {}",
              g, t, tet_count - 1);
      named[static_cast<std::size_t>(t)] = 1;
    }
  const auto none = std::find(named.begin(), named.end(), 0);
  require(none == named.end(), "tetrahedron {} is in no dilatation group", none - named.begin());
}

}  // namespace hyperex::fem
