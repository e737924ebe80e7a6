// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/geodesic.hpp"

#include <algorithm>
#include <queue>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
using Entry = std::pair<double, int>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;
}  // namespace

EdgePaths::EdgePaths(const TriMesh& mesh)
    : points_(mesh.points), around_(vertex_neighbours(mesh.triangles, mesh.points.rows())) {}

std::vector<double> EdgePaths::distances(const std::vector<int>& seeds, double limit) const {
  std::vector<double> distance(around_.size(), infinite);
  Queue queue;
  for (int seed : seeds) {
    distance[seed] = 0;
    queue.push({0, seed});
  }
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[v]) continue;
    for (int w : around_[v]) {
      const double next = d + (points_.row(v) - points_.row(w)).norm();
      if (next < distance[w] && next <= limit) {
        distance[w] = next;
        queue.push({next, w});
      }
    }
  }
  return distance;
}

std::vector<int> EdgePaths::cheapest(int from, int to,
                                     const std::function<double(int, int)>& cost) const {
  std::vector<double> sum(around_.size(), infinite);
  std::vector<int> before(around_.size(), -1);
  Queue queue;
  sum[from] = 0;
  queue.push({0, from});
  while (!queue.empty()) {
    const auto [s, v] = queue.top();
    queue.pop();
    if (s > sum[v]) continue;
    if (v == to) break;
    for (int w : around_[v]) {
      const double next = s + cost(v, w);
      if (next < sum[w]) {
        sum[w] = next;
        before[w] = v;
        queue.push({next, w});
      }
    }
  }
  if (sum[to] == infinite) return {};
  std::vector<int> path;
  for (int v = to; v >= 0; v = before[v]) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

int nearest_vertex(const Points& points, const Vec3& p) {
  Eigen::Index best = 0;
  (points.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&best);
  return static_cast<int>(best);
}

}  // namespace hyperex
