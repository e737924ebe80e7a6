// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/mesh_laplacian.hpp"

#include <Eigen/SparseCholesky>
#include <set>
#include <stdexcept>
#include <vector>

namespace hyperex::expression {

SparseMatrix mesh_laplacian(const TriMesh& mesh) {
  const Eigen::Index size = mesh.points.rows();
  std::vector<std::set<int>> neighbours(static_cast<std::size_t>(size));
  for (const auto t : mesh.triangles.rowwise())
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        if (a != b) neighbours[std::size_t(t[a])].insert(t[b]);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index v = 0; v < size; ++v) {
    const auto& around = neighbours[std::size_t(v)];
    if (around.empty()) continue;
    entries.emplace_back(v, v, 1.0);
    for (const int w : around) entries.emplace_back(v, w, -1.0 / double(around.size()));
  }
  SparseMatrix laplacian(size, size);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

Points smooth_fill(const SparseMatrix& smoothness, const std::map<int, Vec3>& fixed) {
  const Eigen::Index size = smoothness.rows();
  std::vector<int> row_of(std::size_t(size), -1);
  int free_count = 0;
  for (int v = 0; v < size; ++v)
    if (!fixed.contains(v)) row_of[std::size_t(v)] = free_count++;
  Points field = Points::Zero(size, 3);
  for (const auto& [v, value] : fixed) field.row(v) = value.transpose();
  if (free_count == 0) return field;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(free_count, 3);
  for (int column = 0; column < size; ++column)
    for (SparseMatrix::InnerIterator it(smoothness, column); it; ++it) {
      const int row = row_of[std::size_t(it.row())], other = row_of[std::size_t(column)];
      if (row < 0) continue;
      if (other >= 0)
        entries.emplace_back(row, other, it.value());
      else
        right.row(row) -= it.value() * field.row(column);
    }
  SparseMatrix matrix(free_count, free_count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<SparseMatrix> factor(matrix);
  if (factor.info() != Eigen::Success)
    throw std::logic_error("the smoothness leaves vertices without a value");
  const Eigen::MatrixXd solution = factor.solve(right);
  for (int v = 0; v < size; ++v)
    if (row_of[std::size_t(v)] >= 0) field.row(v) = solution.row(row_of[std::size_t(v)]);
  return field;
}

}  // namespace hyperex::expression
