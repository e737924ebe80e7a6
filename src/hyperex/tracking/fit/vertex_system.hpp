// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "hyperex/expression/mesh_laplacian.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tracking {

/// What the measurements of one frame say of the vertices, as a quadratic form in their
/// displacements d (|V| x 3, head frame):  E(d) = 1/2 d^T H d + g^T d + constant.
/// H couples only vertices that share an edge of the mesh. The pattern is made once; a frame clears
/// and fills.
class VertexSystem {
 public:
  /// Rows 3 v ... 3 v + 2 of vertex v.
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit VertexSystem(const TriMesh& mesh);

  void clear();
  /// Adds 1/2 weight (r + j d_v)^2.
  void add_row(int vertex, const Eigen::RowVector3d& j, double r, double weight);
  /// Adds 1/2 weight (r + sum_k bary_k jacobian_k d_k)^2 over the corners of a triangle, already
  /// summed over its pixels: `hessian` over the nine corner coordinates, `gradient` likewise.
  void add_triangle(int triangle, const Eigen::Matrix<double, 9, 9>& hessian,
                    const Eigen::Matrix<double, 9, 1>& gradient);

  /// As if each vertex, beside what moves it here, strayed by `sigma_m` (metres, one per vertex)
  /// as it likes: no vertex then weighs more than 1 / sigma^2, however much was measured of it. H
  /// and g are scaled from both sides by 1 / sqrt(1 + sigma^2 trace(H_vv) / 2), a diagonal stand-in
  /// for H (1 + sigma^2 H)^-1.
  VertexSystem limited(const Eigen::VectorXd& sigma_m) const;
  Eigen::Index vertex_count() const { return Eigen::Index(diagonal_.size()); }
  /// H times a matrix of 3 |V| rows.
  RowMatrix times(const RowMatrix& right) const;
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// H of one vertex with itself.
  const Eigen::Matrix3d& diagonal(int vertex) const { return diagonal_[std::size_t(vertex)]; }

  /// Where the upper triangle of H lies among the values of `pattern`, a compressed 3 |V| x 3 |V|
  /// matrix that has an entry wherever H may: to be given to add_to().
  std::vector<Eigen::Index> slots(const expression::SparseMatrix& pattern) const;
  /// Adds the upper triangle of H to the values of a matrix of that pattern.
  void add_to(expression::SparseMatrix& out, const std::vector<Eigen::Index>& slots) const;

 private:
  struct Edge {
    int a, b;  // a < b
  };
  std::vector<Edge> edges_;
  std::vector<std::array<int, 3>> triangle_edges_;  // (0,1), (1,2), (2,0)
  Triangles triangles_;
  std::vector<Eigen::Matrix3d> diagonal_, edge_blocks_;  // edge block: rows a, columns b
  Eigen::VectorXd gradient_;
};

}  // namespace hyperex::tracking
