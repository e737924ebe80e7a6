// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/vertex_system.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/core/assert.hpp"

namespace hyperex::tracking {

VertexSystem::VertexSystem(const TriMesh& mesh) : triangles_(mesh.triangles) {
  std::map<std::pair<int, int>, int> known;
  for (const auto t : triangles_.rowwise()) {
    std::array<int, 3> edges;
    for (int k = 0; k < 3; ++k) {
      const int a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
      const auto [entry, is_new] = known.try_emplace({a, b}, int(edges_.size()));
      if (is_new) edges_.push_back({a, b});
      edges[std::size_t(k)] = entry->second;
    }
    triangle_edges_.push_back(edges);
  }
  diagonal_.resize(std::size_t(mesh.points.rows()));
  edge_blocks_.resize(edges_.size());
  gradient_.resize(3 * mesh.points.rows());
  clear();
}

void VertexSystem::clear() {
  for (auto& block : diagonal_) block.setZero();
  for (auto& block : edge_blocks_) block.setZero();
  gradient_.setZero();
}

void VertexSystem::add_row(int vertex, const Eigen::RowVector3d& j, double r, double weight) {
  diagonal_[std::size_t(vertex)].noalias() += weight * j.transpose() * j;
  gradient_.segment<3>(3 * vertex) += weight * r * j.transpose();
}

void VertexSystem::add_triangle(int triangle, const Eigen::Matrix<double, 9, 9>& hessian,
                                const Eigen::Matrix<double, 9, 1>& gradient) {
  for (int k = 0; k < 3; ++k) {
    const int v = triangles_(triangle, k), next = (k + 1) % 3, w = triangles_(triangle, next);
    diagonal_[std::size_t(v)] += hessian.block<3, 3>(3 * k, 3 * k);
    gradient_.segment<3>(3 * v) += gradient.segment<3>(3 * k);
    Eigen::Matrix3d& block =
        edge_blocks_[std::size_t(triangle_edges_[std::size_t(triangle)][std::size_t(k)])];
    if (v < w)
      block += hessian.block<3, 3>(3 * k, 3 * next);
    else
      block += hessian.block<3, 3>(3 * next, 3 * k);
  }
}

VertexSystem::RowMatrix VertexSystem::times(const RowMatrix& right) const {
  RowMatrix product(right.rows(), right.cols());
  for (std::size_t v = 0; v < diagonal_.size(); ++v)
    product.middleRows<3>(3 * Eigen::Index(v)).noalias() =
        diagonal_[v] * right.middleRows<3>(3 * Eigen::Index(v));
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto& [a, b] = edges_[e];
    product.middleRows<3>(3 * a).noalias() += edge_blocks_[e] * right.middleRows<3>(3 * b);
    product.middleRows<3>(3 * b).noalias() +=
        edge_blocks_[e].transpose() * right.middleRows<3>(3 * a);
  }
  return product;
}

VertexSystem VertexSystem::limited(const Eigen::VectorXd& sigma_m) const {
  VertexSystem out = *this;
  Eigen::VectorXd share(vertex_count());
  for (Eigen::Index v = 0; v < vertex_count(); ++v)
    share[v] = 1 / std::sqrt(1 + sigma_m[v] * sigma_m[v] * diagonal_[std::size_t(v)].trace() / 2);
  for (Eigen::Index v = 0; v < vertex_count(); ++v) {
    out.diagonal_[std::size_t(v)] *= share[v] * share[v];
    out.gradient_.segment<3>(3 * v) *= share[v] * share[v];
  }
  for (std::size_t e = 0; e < edges_.size(); ++e)
    out.edge_blocks_[e] *= share[edges_[e].a] * share[edges_[e].b];
  return out;
}

std::vector<Eigen::Index> VertexSystem::slots(const expression::SparseMatrix& pattern) const {
  std::vector<Eigen::Index> found;
  const auto find = [&](Eigen::Index row, Eigen::Index column) {
    const int* begin = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
    const int* end = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
    const int* at = std::lower_bound(begin, end, int(row));
    HX_ASSERT(at != end && *at == int(row));
    found.push_back(at - pattern.innerIndexPtr());
  };
  for (Eigen::Index v = 0; v < vertex_count(); ++v)
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c) find(3 * v + r, 3 * v + c);
  for (const auto& [a, b] : edges_)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) find(3 * a + r, 3 * b + c);
  return found;
}

void VertexSystem::add_to(expression::SparseMatrix& out,
                          const std::vector<Eigen::Index>& slots) const {
  double* values = out.valuePtr();
  const Eigen::Index* slot = slots.data();
  for (const auto& block : diagonal_)
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c) values[*slot++] += block(r, c);
  for (const auto& block : edge_blocks_)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) values[*slot++] += block(r, c);
}

}  // namespace hyperex::tracking
