// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "hyperex/expression/mesh_laplacian.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tracking {

/// The measurements of one frame as a quadratic form in the displacements d of the vertices (|V| x
/// 3, head frame):  E(d) = 1/2 d^T H d + g^T d + constant. H couples only vertices that share an
/// edge of the mesh. The pattern is created once; for each frame, the values are cleared and
/// filled.
class VertexSystem {
 public:
  /// Rows 3 v ... 3 v + 2 belong to vertex v.
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit VertexSystem(const TriMesh& mesh);

  void clear();
  /// Adds 1/2 weight (r + j d_v)^2.
  void add_row(int vertex, const Eigen::RowVector3d& j, double r, double weight);
  /// Adds 1/2 weight (r + sum_k bary_k jacobian_k d_k)^2 for all pixels of a triangle, already
  /// summed. `hessian` and `gradient` refer to the nine coordinates of its corners.
  void add_triangle(int triangle, const Eigen::Matrix<double, 9, 9>& hessian,
                    const Eigen::Matrix<double, 9, 1>& gradient);

  /// The system with an additional independent deviation of each vertex, with standard deviation
  /// `sigma_m` (metres, one per vertex). The weight of a vertex is thereby limited to 1 / sigma^2,
  /// however many measurements it has. H and g are scaled from both sides by 1 / sqrt(1 + sigma^2
  /// trace(H_vv) / 2), a diagonal approximation of H (1 + sigma^2 H)^-1.
  VertexSystem limited(const Eigen::VectorXd& sigma_m) const;
  Eigen::Index vertex_count() const { return Eigen::Index(diagonal_.size()); }
  /// H times a matrix of 3 |V| rows.
  RowMatrix times(const RowMatrix& right) const;
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// The diagonal block of H for one vertex.
  const Eigen::Matrix3d& diagonal(int vertex) const { return diagonal_[std::size_t(vertex)]; }

  /// Positions of the upper triangle of H among the values of `pattern`, a compressed 3 |V| x 3 |V|
  /// matrix that has an entry wherever H may have one. To be passed to add_to().
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
