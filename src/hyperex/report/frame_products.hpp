// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::report {

// A motion as the 3|V| x N matrix X of its frames.

/// Rows of X in double precision: the coordinates of `count` vertices starting at `first`, one
/// column per frame.
void gather(const std::vector<PointsF>& frames, Eigen::Index first, Eigen::Index count,
            Eigen::MatrixXd& block);

/// Calls visit(first, count, block) for X in blocks of vertices, because all of X in double
/// precision would need twice the memory of the frames. `visit` may change the block.
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

/// Eigenvectors of a Gram matrix (lower half) and their eigenvalues, in decreasing order.
/// Eigenvalues below 1e-15 of the greatest are rounding errors and are left out.
Eigen::MatrixXd leading_eigenvectors(const Eigen::MatrixXd& gram, Eigen::VectorXd& values);

/// The greatest length of the 3-vectors (one per vertex) in all columns.
double largest_row_error(const Eigen::MatrixXd& residual);

/// With more frames than this, the eigenvectors of X^T X would take too long: the time grows with
/// the third power (five minutes for 5,000 frames, which some thirty shapes represent).
inline constexpr Eigen::Index kFramesAtOnce = 512;

/// S^T X, rank x N, for orthonormal shapes S whose span represents every vertex in every frame to
/// within `allowed_m`.
Eigen::MatrixXd courses_along_few_shapes(const std::vector<PointsF>& frames, double allowed_m);

/// N rows with the same lengths and angles as the frames: C C^T = X^T X to rounding. With more
/// frames and coordinates than kFramesAtOnce, each vertex may additionally be off by `allowed_m`.
Eigen::MatrixXd frame_coordinates(const std::vector<PointsF>& frames, double allowed_m);

}  // namespace hyperex::report
