// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/dilatation_groups.hpp"

namespace hyperex::fem {

Lists corner_lists(const Tetrahedra& tets) {
  Lists corners;
  corners.item.assign(tets.data(), tets.data() + tets.size());
  corners.start.resize(tets.rows() + 1);
  for (Eigen::Index t = 0; t <= tets.rows(); ++t) corners.start[t] = static_cast<int>(4 * t);
  return corners;
}

DilatationGroups node_stars(Eigen::Index node_count, const Tetrahedra& tets, double kept) {
  return {transposed(corner_lists(tets), static_cast<int>(node_count)), kept};
}

DilatationGroups dilatation_groups(ElementKind kind, Eigen::Index node_count,
                                   const Tetrahedra& tets) {
  constexpr double kKept = 2.0 / 3;
  if (kind == ElementKind::tet4_nodal) return node_stars(node_count, tets, kKept);
  return {};
}

}  // namespace hyperex::fem
