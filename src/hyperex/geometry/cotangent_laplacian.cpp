// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/cotangent_laplacian.hpp"

#include <cmath>
#include <vector>

namespace hyperex {
namespace {
constexpr double kMostCotangent = 1e3;  // a triangle with a greater one counts as without area
}  // namespace

Eigen::SparseMatrix<double> cotangent_laplacian(const TriMesh& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(std::size_t(12 * mesh.triangles.rows()));
  for (const auto t : mesh.triangles.rowwise())
    for (int k = 0; k < 3; ++k) {
      const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const Vec3 to_a = mesh.points.row(a) - mesh.points.row(t[k]);
      const Vec3 to_b = mesh.points.row(b) - mesh.points.row(t[k]);
      const double twice_area = to_a.cross(to_b).norm();
      const double cotangent = to_a.dot(to_b) / twice_area;
      if (!(std::abs(cotangent) < kMostCotangent)) continue;
      const double weight = cotangent / 2;
      entries.emplace_back(a, b, -weight);
      entries.emplace_back(b, a, -weight);
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
    }
  Eigen::SparseMatrix<double> laplacian(mesh.points.rows(), mesh.points.rows());
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

}  // namespace hyperex
