// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/mesh_border.hpp"

#include <algorithm>
#include <map>

namespace hyperex::expression {

BorderEdges border_edges(const TriMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto t : mesh.triangles.rowwise())
    for (int k = 0; k < 3; ++k) ++uses[std::minmax({t[k], t[(k + 1) % 3]})];
  std::map<int, std::vector<int>> next;
  for (const auto& [edge, count] : uses)
    if (count == 1) {
      next[edge.first].push_back(edge.second);
      next[edge.second].push_back(edge.first);
    }
  std::map<int, std::size_t> piece_of;
  std::vector<double> length;
  for (const auto& [seed, around] : next) {
    if (!piece_of.try_emplace(seed, length.size()).second) continue;
    double sum = 0;
    for (std::vector<int> waiting = {seed}; !waiting.empty();) {
      const int v = waiting.back();
      waiting.pop_back();
      for (const int w : next[v]) {
        sum += (mesh.points.row(v) - mesh.points.row(w)).norm();
        if (piece_of.try_emplace(w, length.size()).second) waiting.push_back(w);
      }
    }
    length.push_back(sum);
  }
  BorderEdges border;
  if (length.empty()) return border;
  const auto longest = std::size_t(std::max_element(length.begin(), length.end()) - length.begin());
  for (const auto& [edge, count] : uses)
    if (count == 1)
      (piece_of[edge.first] == longest ? border.outline : border.openings).push_back(edge);
  return border;
}

}  // namespace hyperex::expression
