// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/subdomains.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "hyperex/core/assert.hpp"

namespace hyperex::fem {
namespace {

/// Parts of equal size, each a list of nodes.
void halve(const Points& points, std::span<int> nodes, int parts, std::vector<int>& part_of,
           int& next) {
  if (parts == 1) {
    for (const int n : nodes) part_of[n] = next;
    ++next;
    return;
  }
  Vec3 low = points.row(nodes[0]), high = low;
  for (const int n : nodes) {
    low = low.cwiseMin(points.row(n).transpose());
    high = high.cwiseMax(points.row(n).transpose());
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const int left = parts / 2;
  const std::size_t cut = nodes.size() * left / parts;
  std::nth_element(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(cut), nodes.end(),
                   [&](int a, int b) {
                     return points(a, axis) != points(b, axis) ? points(a, axis) < points(b, axis)
                                                               : a < b;
                   });
  halve(points, nodes.first(cut), left, part_of, next);
  halve(points, nodes.subspan(cut), parts - left, part_of, next);
}

}  // namespace

Subdomains overlapping_subdomains(const NodeBlocks& a, const Points& points, int target) {
  HX_ASSERT(points.rows() == a.node_count() && target > 0);
  Subdomains out;
  const int count = a.node_count();
  if (count == 0) return out;
  std::vector<int> nodes(count), part_of(count);
  std::iota(nodes.begin(), nodes.end(), 0);
  int parts = 0;
  halve(points, nodes, (count + target - 1) / target, part_of, parts);

  std::vector<std::vector<int>> own(parts);
  for (int n = 0; n < count; ++n) own[part_of[n]].push_back(n);
  std::vector<int> seen(count, -1), times(count, 0);
  for (int p = 0; p < parts; ++p) {
    std::vector<int> all;
    for (const int n : own[p])
      for (int k = a.row_start(n); k < a.row_start(n + 1); ++k)
        if (const int other = a.columns()[k]; seen[other] != p) {
          seen[other] = p;
          all.push_back(other);
        }
    std::sort(all.begin(), all.end());
    for (const int n : all) ++times[n];
    out.nodes.append(all);
  }
  out.weight.reserve(out.nodes.item.size());
  for (int p = 0; p < parts; ++p)
    for (const int n : out.nodes[p])
      out.weight.push_back((part_of[n] == p ? 2.0 : 1.0) / (times[n] + 1));
  return out;
}

}  // namespace hyperex::fem
