// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::test {

/// Each triangle cut into four at the middles of its edges; the given vertices come first.
inline TriMesh subdivided(const TriMesh& mesh) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Vec3> added;
  const auto middle = [&](int a, int b) {
    const auto next = int(mesh.points.rows()) + int(added.size());
    const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), next);
    if (fresh) added.push_back(0.5 * (mesh.points.row(a) + mesh.points.row(b)).transpose());
    return at->second;
  };
  TriMesh out;
  out.triangles.resize(4 * mesh.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    out.triangles.middleRows<4>(4 * f) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
  }
  out.points.resize(mesh.points.rows() + Eigen::Index(added.size()), 3);
  out.points.topRows(mesh.points.rows()) = mesh.points;
  for (std::size_t i = 0; i < added.size(); ++i)
    out.points.row(mesh.points.rows() + Eigen::Index(i)) = added[i].transpose();
  return out;
}

}  // namespace hyperex::test
