// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace hyperex::simulate {

/// What a fit leaves over at points, as directions with time courses, each of one part of the face:
/// the residual is directions * course, but for what hardly matters.
struct LeftOver {
  Eigen::MatrixXd directions;       ///< 3 P x k, orthonormal within a part
  Eigen::MatrixXd course;           ///< k x samples, m
  std::vector<Eigen::Index> parts;  ///< of the k directions
};

/// `residual`: 3 P x samples, m. `shares` (P x parts, rows of sum 1): how much of a point's
/// residual belongs to each part. Directions of less than 1e-4 of the greatest one are left out.
LeftOver divided(const Eigen::MatrixXd& residual, const Eigen::MatrixXd& shares);

}  // namespace hyperex::simulate
