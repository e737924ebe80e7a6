// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/dilatation_groups.hpp"

#include <array>
#include <cassert>
#include <queue>

namespace hyperex::fem {
namespace {

/// Star (or -1) of each tetrahedron. Next is always the node with most neighbours in stars already,
/// the first of several: stars then lie side by side, with little between them.
std::vector<int> pack_stars(const Lists& around, const Lists& neighbours, std::size_t tet_count) {
  std::vector<int> star(tet_count, -1), covered(around.size(), 0);
  std::vector<char> taken(around.size(), 0);       // in a star, as its centre or around it
  std::priority_queue<std::pair<int, int>> queue;  // (covered neighbours, -node), some outdated
  for (int n = 0; n < around.size(); ++n)
    if (!around[n].empty()) queue.emplace(0, -n);
  int stars = 0;
  while (!queue.empty()) {
    const auto [count, negative] = queue.top();
    queue.pop();
    const int centre = -negative;
    // A tetrahedron around this node lies in a star exactly if the node does.
    if (taken[centre] || count != covered[centre]) continue;
    for (const int t : around[centre]) star[t] = stars;
    ++stars;
    std::vector<int> newly;
    for (const int n : neighbours[centre])
      if (!taken[n]) newly.push_back(n);
    for (const int n : newly) taken[n] = 1;
    for (const int n : newly)
      for (const int k : neighbours[n])
        if (!taken[k]) queue.emplace(++covered[k], -k);
  }
  return star;
}

/// The star that shares most corners with tetrahedron t, the first of several.
int nearest_star(Eigen::Index t, const Tetrahedra& tets, const Lists& around,
                 const std::vector<int>& star) {
  int most = 0, nearest = -1;
  for (int a = 0; a < 4; ++a)
    for (const int other : around[tets(t, a)]) {
      if (star[other] < 0) continue;
      int shared = 0;
      for (int i = 0; i < 4; ++i) shared += (tets.row(other).array() == tets(t, i)).any();
      if (shared > most) {
        most = shared;
        nearest = star[other];
      }
    }
  assert(nearest >= 0);  // else the star of a corner would have fitted
  return nearest;
}

}  // namespace

Lists corner_lists(const Tetrahedra& tets) {
  Lists corners;
  corners.item.assign(tets.data(), tets.data() + tets.size());
  corners.start.resize(tets.rows() + 1);
  for (Eigen::Index t = 0; t <= tets.rows(); ++t) corners.start[t] = static_cast<int>(4 * t);
  return corners;
}

DilatationGroups disjoint_stars(Eigen::Index node_count, const Tetrahedra& tets) {
  const Lists corners = corner_lists(tets);
  const Lists around = transposed(corners, static_cast<int>(node_count));
  const std::vector<int> star = pack_stars(around, joined(around, corners), tets.rows());
  Lists patch_of_tet;
  int stars = 0;
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const int patch = star[t] >= 0 ? star[t] : nearest_star(t, tets, around, star);
    patch_of_tet.append(std::array{patch});
    stars = std::max(stars, patch + 1);
  }
  return {transposed(patch_of_tet, stars)};
}

DilatationGroups dilatation_groups(ElementKind kind, Eigen::Index node_count,
                                   const Tetrahedra& tets) {
  return kind == ElementKind::tet4_star ? disjoint_stars(node_count, tets) : DilatationGroups{};
}

}  // namespace hyperex::fem
