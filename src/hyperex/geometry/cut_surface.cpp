// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/cut_surface.hpp"

#include <map>
#include <set>
#include <stdexcept>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {
using Edge = std::pair<int, int>;

/// The triangles of `fan` reached from `first` across edges at `v` that are not in `barrier`.
std::set<int> side_of_fan(const Triangles& triangles, const std::vector<int>& fan, int v, int first,
                          const std::set<int>& barrier) {
  std::map<int, std::vector<int>> by_neighbour;
  for (int f : fan)
    for (int k = 0; k < 3; ++k)
      if (triangles(f, k) != v) by_neighbour[triangles(f, k)].push_back(f);
  std::set<int> side{first};
  std::vector<int> stack{first};
  while (!stack.empty()) {
    const int f = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const int w = triangles(f, k);
      if (w == v || barrier.count(w)) continue;
      for (int g : by_neighbour[w])
        if (side.insert(g).second) stack.push_back(g);
    }
  }
  return side;
}
}  // namespace

CutSurface cut_along(const TriMesh& mesh, const std::vector<int>& path) {
  CutSurface out{mesh, {}};
  if (path.size() < 3) return out;
  std::map<Edge, int> triangle_left_of;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      triangle_left_of[{mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)}] =
          static_cast<int>(f);
  const auto fans = vertex_triangles(mesh.triangles, mesh.points.rows());
  const auto right_of = [&](int a, int b) {
    const auto it = triangle_left_of.find({b, a});
    if (it == triangle_left_of.end() || !triangle_left_of.count({a, b}))
      throw std::invalid_argument("the cut runs along a border or off the edges of the surface");
    return it->second;
  };
  const Eigen::Index old = mesh.points.rows();
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const int v = path[i];
    const std::set<int> side = side_of_fan(mesh.triangles, fans[v], v, right_of(path[i - 1], v),
                                           {path[i - 1], path[i + 1]});
    if (side.count(triangle_left_of.at({path[i - 1], v})))
      throw std::invalid_argument("the cut touches a border between its ends");
    const int copy = static_cast<int>(old + static_cast<Eigen::Index>(out.duplicated_from.size()));
    out.duplicated_from.push_back(v);
    for (int f : side)
      for (int k = 0; k < 3; ++k)
        if (mesh.triangles(f, k) == v) out.mesh.triangles(f, k) = copy;
  }
  out.mesh.points.conservativeResize(old + static_cast<Eigen::Index>(out.duplicated_from.size()),
                                     3);
  for (std::size_t i = 0; i < out.duplicated_from.size(); ++i)
    out.mesh.points.row(old + static_cast<Eigen::Index>(i)) =
        mesh.points.row(out.duplicated_from[i]);
  return out;
}

}  // namespace hyperex
