// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::report {

// A motion as the 3|V| x N matrix X of its frames.

/// Rows of X in double precision: coordinates of `count` vertices from `first` on, by frames.
void gather(const std::vector<PointsF>& frames, Eigen::Index first, Eigen::Index count,
            Eigen::MatrixXd& block);

/// Visits X in blocks of vertices, since the whole of it in double precision would need twice the
/// memory of the frames themselves: visit(first, count, block), which may change the block.
template <typename Visit>
void for_blocks(const std::vector<PointsF>& frames, Visit visit) {
  constexpr Eigen::Index block_vertices = 2048;
  const Eigen::Index vertices = frames.front().rows();
  Eigen::MatrixXd block;
  for (Eigen::Index first = 0; first < vertices; first += block_vertices) {
    const Eigen::Index count = std::min(block_vertices, vertices - first);
    gather(frames, first, count, block);
    visit(first, count, block);
  }
}

/// X^T X, N x N, lower half.
Eigen::MatrixXd frame_products(const std::vector<PointsF>& frames);

/// Eigenvectors of a Gram matrix (its lower half), most important first, and their values;
/// directions below its rounding (1e-15 of the greatest) carry nothing and are left out.
Eigen::MatrixXd leading_eigenvectors(const Eigen::MatrixXd& gram, Eigen::VectorXd& values);

/// The longest vector among a column's threes, over all columns.
double largest_row_error(const Eigen::MatrixXd& residual);

/// Of more frames X^T X itself costs: its eigenvectors grow with the third power (five minutes for
/// 5,000 frames, which move in some thirty shapes).
inline constexpr Eigen::Index kFramesAtOnce = 512;

/// S^T X, rank x N, with orthonormal shapes S that hold every vertex of every frame within
/// `allowed_m`.
Eigen::MatrixXd courses_along_few_shapes(const std::vector<PointsF>& frames, double allowed_m);

/// N rows with the lengths and angles of the frames: C C^T = X^T X to rounding, of more frames and
/// coordinates than kFramesAtOnce but for what lies within `allowed_m` of each vertex.
Eigen::MatrixXd frame_coordinates(const std::vector<PointsF>& frames, double allowed_m);

}  // namespace hyperex::report
