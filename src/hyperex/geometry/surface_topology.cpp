// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/surface_topology.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

#include "hyperex/geometry/directed_edges.hpp"

namespace hyperex {
std::vector<std::vector<int>> boundary_loops(const Triangles& triangles) {
  DirectedEdges directed(3 * static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) directed.insert(triangles(f, k), triangles(f, (k + 1) % 3));
  // A border edge belongs to one triangle only. The loop runs in the direction of that triangle.
  std::map<int, std::vector<int>> next;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      if (!directed.contains(b, a)) next[a].push_back(b);
    }
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int> loop;
    const int start = next.begin()->first;
    int at = start;
    while (true) {
      auto it = next.find(at);
      // An open chain: occurs only if the triangles are not oriented consistently.
      if (it == next.end()) break;
      loop.push_back(at);
      const int to = it->second.back();
      it->second.pop_back();
      if (it->second.empty()) next.erase(it);
      at = to;
      if (at == start) break;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double loop_length(const std::vector<int>& loop, const Points& points) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (points.row(loop[(i + 1) % loop.size()]) - points.row(loop[i])).norm();
  return sum;
}

std::vector<std::vector<int>> vertex_neighbours(const Triangles& triangles, Eigen::Index vertices) {
  std::vector<std::vector<int>> around(vertices);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      around[triangles(f, k)].push_back(triangles(f, (k + 1) % 3));
      around[triangles(f, k)].push_back(triangles(f, (k + 2) % 3));
    }
  for (auto& list : around) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return around;
}

std::vector<std::vector<int>> vertex_triangles(const Triangles& triangles, Eigen::Index vertices) {
  std::vector<std::vector<int>> around(vertices);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) around[triangles(f, k)].push_back(static_cast<int>(f));
  return around;
}

std::vector<int> triangle_components(const Triangles& triangles, Eigen::Index vertices) {
  std::vector<int> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 1; k < 3; ++k) parent[root(triangles(f, k))] = root(triangles(f, 0));
  std::unordered_map<int, int> number;
  std::vector<int> component(triangles.rows());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    component[f] =
        number.try_emplace(root(triangles(f, 0)), static_cast<int>(number.size())).first->second;
  return component;
}

Points vertex_normals(const TriMesh& mesh) {
  Points normals = Points::Zero(mesh.points.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
               c = mesh.points.row(mesh.triangles(f, 2));
    const Vec3 n = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) normals.row(mesh.triangles(f, k)) += n.transpose();
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0) normals.row(v) /= length;
  }
  return normals;
}

Eigen::VectorXd triangle_areas(const TriMesh& mesh) {
  Eigen::VectorXd areas(mesh.triangles.rows());
  for (Eigen::Index f = 0; f < areas.size(); ++f) {
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
               c = mesh.points.row(mesh.triangles(f, 2));
    areas[f] = 0.5 * (b - a).cross(c - a).norm();
  }
  return areas;
}

std::vector<char> touching(const Triangles& triangles, const std::vector<char>& flagged_vertices) {
  std::vector<char> touches(triangles.rows(), 0);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) touches[f] |= flagged_vertices[triangles(f, k)];
  return touches;
}

}  // namespace hyperex
