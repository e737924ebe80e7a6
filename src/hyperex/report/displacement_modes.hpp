// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::report {

/// A motion as few shapes: displacement(f) = sum_k weights(f, k) * modes[k]. A face that opens its
/// mouth in 81 frames needs about ten, which is what makes glTF and the replay small.
struct DisplacementModes {
  std::vector<PointsF> modes;  ///< K of |V| x 3, metres, largest first
  Eigen::MatrixXf weights;     ///< N x K, each column's largest magnitude is 1 and positive there
  double max_error_m = 0;      ///< largest distance of any vertex in any frame from its true place

  PointsF displacement(Eigen::Index frame) const;  ///< |V| x 3, metres
};

/// Truncated singular value decomposition of the 3|V| x N matrix of `frames` through its smaller
/// Gram matrix (of more than 512 frames and coordinates within a fiftieth of the tolerance, through
/// the shapes that span them), with the least K for which max_error_m <= tolerance_m (K <= N; where
/// N modes are not enough, tolerance_m lies below the rounding of single precision and max_error_m
/// says by how much). No frames or frames without motion give K = 0. Requires: frames of equal
/// size, finite.
DisplacementModes displacement_modes(const std::vector<PointsF>& frames, double tolerance_m = 2e-5);

}  // namespace hyperex::report
