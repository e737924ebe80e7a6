// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/supernodes.hpp"

#include <algorithm>

namespace hyperex::fem {

std::vector<int> parents(const Supernodes& f) {
  std::vector<int> holder(f.columns), parent(f.count, -1);
  for (int s = 0; s < f.count; ++s)
    std::fill(holder.begin() + f.first[s], holder.begin() + f.first[s + 1], s);
  for (int s = 0; s < f.count; ++s) {
    const Panel p = panel(f, s);
    if (p.below > 0) parent[s] = holder[p.rows[0]];
  }
  return parent;
}

std::vector<int> halves(const Supernodes& f, const std::vector<int>& parent,
                        const std::function<double(const Panel&)>& work) {
  std::vector<double> weight(f.count);  // work of the whole subtree
  std::vector<std::vector<int>> children(f.count);
  std::vector<int> subtrees;
  for (int s = 0; s < f.count; ++s) {
    weight[s] += work(panel(f, s));
    if (parent[s] < 0) {
      subtrees.push_back(s);
    } else {
      weight[parent[s]] += weight[s];
      children[parent[s]].push_back(s);
    }
  }
  std::vector<int> half_of_root(f.count, -1);
  const auto share_out = [&] {
    double heap[2] = {0, 0};
    std::sort(subtrees.begin(), subtrees.end(),
              [&](int a, int b) { return weight[a] != weight[b] ? weight[a] > weight[b] : a < b; });
    for (const int s : subtrees) {
      half_of_root[s] = heap[1] < heap[0];
      heap[half_of_root[s]] += weight[s];
    }
    return std::max(heap[0], heap[1]) <= 0.53 * (heap[0] + heap[1]);
  };
  while (!subtrees.empty() && !share_out()) {
    const int heaviest = subtrees.front();
    half_of_root[heaviest] = -1;
    subtrees.erase(subtrees.begin());
    subtrees.insert(subtrees.end(), children[heaviest].begin(), children[heaviest].end());
  }
  std::vector<int> half(f.count, -1);
  for (int s = f.count - 1; s >= 0; --s)
    half[s] = half_of_root[s] >= 0 ? half_of_root[s] : parent[s] >= 0 ? half[parent[s]] : -1;
  return half;
}

}  // namespace hyperex::fem
