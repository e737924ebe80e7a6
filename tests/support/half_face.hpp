// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::test {

/// The triangles of `whole` whose three corners are all kept, without the other vertices.
inline TriMesh part_of(const TriMesh& whole, const std::function<bool(const Vec3&)>& kept) {
  std::vector<int> now(std::size_t(whole.points.rows()), -1);
  std::vector<Eigen::Index> vertices, triangles;
  for (Eigen::Index v = 0; v < whole.points.rows(); ++v) {
    if (!kept(whole.points.row(v).transpose())) continue;
    now[std::size_t(v)] = int(vertices.size());
    vertices.push_back(v);
  }
  const auto of = [&](Eigen::Index f, int corner) -> int {
    return now[std::size_t(whole.triangles(f, corner))];
  };
  for (Eigen::Index f = 0; f < whole.triangles.rows(); ++f)
    if (of(f, 0) >= 0 && of(f, 1) >= 0 && of(f, 2) >= 0) triangles.push_back(f);
  TriMesh part;
  part.points.resize(Eigen::Index(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    part.points.row(Eigen::Index(i)) = whole.points.row(vertices[i]);
  part.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      part.triangles(Eigen::Index(i), corner) = of(triangles[i], corner);
  return part;
}

/// The subject's right or left half of a face whose x points to the subject's left.
inline TriMesh half_face(const TriMesh& whole, bool left) {
  return part_of(whole, [&](const Vec3& p) { return (left ? p.x() : -p.x()) > -1e-6; });
}

}  // namespace hyperex::test
