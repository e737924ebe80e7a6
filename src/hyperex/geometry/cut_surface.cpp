// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/cut_surface.hpp"

#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {
using Edge = std::pair<int, int>;

/// The triangles of `fan` that can be reached from `first` across edges at `v` without crossing an
/// edge to a vertex in `barrier`.
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
  CutSurface out{mesh, {}, {}, path, path};
  out.source_triangle.resize(mesh.triangles.rows());
  std::iota(out.source_triangle.begin(), out.source_triangle.end(), 0);
  if (path.size() < 3) return out;
  std::vector<char> on_path(mesh.points.rows(), 0);
  for (const int v : path) on_path[v] = 1;
  std::map<Edge, int> triangle_left_of;  // of the edges between vertices of the path
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (const Edge edge{mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)};
          on_path[edge.first] && on_path[edge.second])
        triangle_left_of[edge] = static_cast<int>(f);
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
    out.right_rim[i] = static_cast<int>(old + static_cast<Eigen::Index>(out.appended.size()));
    out.appended.push_back({v, v, 0});
    for (int f : side)
      for (int k = 0; k < 3; ++k)
        if (mesh.triangles(f, k) == v) out.mesh.triangles(f, k) = out.right_rim[i];
  }
  out.mesh.points.conservativeResize(old + static_cast<Eigen::Index>(out.appended.size()), 3);
  for (std::size_t i = 0; i < out.appended.size(); ++i)
    out.mesh.points.row(old + static_cast<Eigen::Index>(i)) = mesh.points.row(out.appended[i].a);
  return out;
}

CutSurface cut_along_line(const TriMesh& mesh, const Points& line, const Vec3& towards_viewer) {
  LinedSurface lined = insert_line(mesh, line, towards_viewer);
  CutSurface out = cut_along(lined.mesh, lined.path);
  const auto old = static_cast<int>(mesh.points.rows());
  std::vector<EdgePoint> appended = lined.appended;
  for (const EdgePoint& copy : out.appended)
    appended.push_back(copy.a < old ? copy : lined.appended[copy.a - old]);
  out.appended = std::move(appended);
  out.source_triangle = std::move(lined.source_triangle);
  return out;
}

}  // namespace hyperex
