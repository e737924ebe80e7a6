// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::report {

/// A motion as the sum of a few shapes: displacement(f) = sum_k weights(f, k) * modes[k]. A mouth
/// opening of 81 frames needs about ten modes, which keeps glTF files and the replay small.
struct DisplacementModes {
  std::vector<PointsF> modes;  ///< K of |V| x 3, metres, largest first
  Eigen::MatrixXf weights;     ///< N x K, each column's largest magnitude is 1 and positive there
  double max_error_m = 0;      ///< largest distance of any vertex in any frame from its true place

  PointsF displacement(Eigen::Index frame) const;  ///< |V| x 3, metres
};

/// Truncated singular value decomposition of the 3|V| x N matrix of `frames`, computed from its
/// smaller Gram matrix. With more than 512 frames and coordinates, the matrix is first reduced to
/// the shapes that span it within a fiftieth of the tolerance. K is the least number for which
/// max_error_m <= tolerance_m. If even K = N is not enough, tolerance_m is below the rounding of
/// single precision, and max_error_m states the error. K = 0 if there are no frames or no motion.
/// The frames must have equal size and be finite.
DisplacementModes displacement_modes(const std::vector<PointsF>& frames, double tolerance_m = 2e-5);

}  // namespace hyperex::report
