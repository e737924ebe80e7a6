// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/plane_section.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace hyperex {

Points plane_section(const TriMesh& mesh, const Vec3& at, const Vec3& normal) {
  const Eigen::VectorXd above = (mesh.points.rowwise() - at.transpose()) * normal;
  std::vector<Vec3> ends;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    std::array<Vec3, 2> cut;
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
      if ((above[a] < 0) == (above[b] < 0)) continue;
      const double share = above[a] / (above[a] - above[b]);
      cut[std::min<std::size_t>(count++, 1)] =
          (1 - share) * mesh.points.row(a).transpose() + share * mesh.points.row(b).transpose();
    }
    if (count == 2) ends.insert(ends.end(), cut.begin(), cut.end());
  }
  Points out(Eigen::Index(ends.size()), 3);
  for (std::size_t i = 0; i < ends.size(); ++i) out.row(Eigen::Index(i)) = ends[i].transpose();
  return out;
}

}  // namespace hyperex
