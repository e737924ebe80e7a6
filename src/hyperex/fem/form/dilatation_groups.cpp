// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/dilatation_groups.hpp"

#include <algorithm>
#include <array>
#include <queue>

#include "hyperex/fem/form/mesh_entry.hpp"

namespace hyperex::fem {
namespace {

/// Smaller stars, at corners and edges of the mesh, do not form patches. If their nodes are fixed,
/// nothing in them can move in response to a pressure.
constexpr std::size_t kLeastStar = 8;

/// The number of the star of each tetrahedron, or -1. The next centre is always the node with most
/// neighbours in existing stars; among several, that with the lowest index. Stars then lie close
/// together, with few tetrahedra between them.
std::vector<int> pack_stars(const Lists& around, const Lists& neighbours, std::size_t tet_count) {
  std::vector<int> star(tet_count, -1), covered(around.size(), 0);
  std::vector<char> taken(around.size(), 0);  // in a star, as its centre or around it
  // (covered neighbours, -node); some entries are outdated.
  std::priority_queue<std::pair<int, int>> queue;
  const auto offer = [&](int n) {
    if (around[n].size() >= kLeastStar) queue.emplace(covered[n], -n);
  };
  for (int n = 0; n < around.size(); ++n) offer(n);
  for (int stars = 0; !queue.empty();) {
    const auto [count, negative] = queue.top();
    queue.pop();
    const int centre = -negative;
    // A tetrahedron around this node is in a star exactly if this node is in one.
    if (taken[centre] || count != covered[centre]) continue;
    for (const int t : around[centre]) star[t] = stars;
    ++stars;
    std::vector<int> newly;
    for (const int n : neighbours[centre])
      if (!taken[n]) newly.push_back(n);
    for (const int n : newly) taken[n] = 1;
    for (const int n : newly)
      for (const int k : neighbours[n])
        if (!taken[k]) {
          ++covered[k];
          offer(k);
        }
  }
  return star;
}

/// The patch that shares most corners with tetrahedron t (the first among several); -1 if none
/// does.
int nearest_patch(Eigen::Index t, const Tetrahedra& tets, const Lists& around,
                  const std::vector<int>& patch) {
  int most = 0, nearest = -1;
  for (int a = 0; a < 4; ++a)
    for (const int other : around[tets(t, a)]) {
      if (patch[other] < 0) continue;
      int shared = 0;
      for (int i = 0; i < 4; ++i) shared += (tets.row(other).array() == tets(t, i)).any();
      if (shared > most) {
        most = shared;
        nearest = patch[other];
      }
    }
  return nearest;
}

/// Assigns every remaining tetrahedron to a patch, in layers that grow from the stars.
void fill_between(const Tetrahedra& tets, const Lists& around, std::vector<int>& patch) {
  int patches = patch.empty() ? 0 : *std::max_element(patch.begin(), patch.end()) + 1;
  std::vector<int> open;
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    if (patch[t] < 0) open.push_back(static_cast<int>(t));
  while (!open.empty()) {
    const std::vector<int> before = patch;
    for (const int t : open) patch[t] = nearest_patch(t, tets, around, before);
    const std::size_t count = open.size();
    std::erase_if(open, [&](int t) { return patch[t] >= 0; });
    if (open.size() == count) {  // a component of the mesh too small for a star
      for (const int t : around[tets(open.front(), 0)]) patch[t] = patches;
      ++patches;
      std::erase_if(open, [&](int t) { return patch[t] >= 0; });
    }
  }
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
  check_corners(node_count, tets);
  const Lists corners = corner_lists(tets);
  const Lists around = transposed(corners, static_cast<int>(node_count));
  std::vector<int> patch = pack_stars(around, joined(around, corners), tets.rows());
  fill_between(tets, around, patch);
  Lists patch_of_tet;
  for (const int p : patch) patch_of_tet.append(std::array{p});
  const int count = patch.empty() ? 0 : *std::max_element(patch.begin(), patch.end()) + 1;
  return {transposed(patch_of_tet, count)};
}

DilatationGroups dilatation_groups(ElementKind kind, Eigen::Index node_count,
                                   const Tetrahedra& tets) {
  return kind == ElementKind::tet4_star ? disjoint_stars(node_count, tets) : DilatationGroups{};
}

}  // namespace hyperex::fem
