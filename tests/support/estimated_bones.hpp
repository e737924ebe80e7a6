// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/simulate/drive/support.hpp"

namespace hyperex::test {

/// The inner surface of a mesh over one bone, as the program estimates it: of each triangle, the
/// thirds of the corners that lie over this bone.
inline TriMesh estimated_bone(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                              anatomy::Bone bone) {
  const std::vector<anatomy::Bone> under = simulate::bones_under(mesh, landmarks);
  const Triangles& all = mesh.volume.outer.triangles;
  std::vector<Vec3> corners;
  for (Eigen::Index f = 0; f < all.rows(); ++f) {
    const auto at = [&](int k) -> Vec3 {
      return mesh.volume.nodes.row(mesh.volume.inner_node(all(f, k % 3)));
    };
    const Vec3 middle = (at(0) + at(1) + at(2)) / 3;
    for (int k = 0; k < 3; ++k) {
      if (under[std::size_t(all(f, k))] != bone) continue;
      const Vec3 next = (at(k) + at(k + 1)) / 2, last = (at(k) + at(k + 2)) / 2;
      corners.insert(corners.end(), {at(k), next, middle, at(k), middle, last});
    }
  }
  TriMesh out{Points(Eigen::Index(corners.size()), 3),
              Triangles(Eigen::Index(corners.size() / 3), 3)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    out.points.row(Eigen::Index(i)) = corners[i];
    out.triangles(Eigen::Index(i / 3), Eigen::Index(i % 3)) = int(i);
  }
  return out;
}

}  // namespace hyperex::test
