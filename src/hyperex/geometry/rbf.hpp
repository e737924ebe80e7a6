// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The polynomial that is added to the kernels. It is reproduced exactly everywhere.
enum class RbfPolynomial { constant, affine };

struct RbfOptions {
  RbfPolynomial polynomial = RbfPolynomial::constant;
  /// >= 0, length. 0: interpolates the data. Greater values approximate them (ridge on the kernel
  /// matrix).
  double smoothing = 0;
  /// Centres within this distance are merged into one, at their mean position with the mean value.
  double merge_distance = 1e-9;
};

/// Interpolation of vectors given at scattered points, with the linear kernel (biharmonic in 3D):
///   s(x) = sum_i w_i |x - c_i| + p(x),  sum_i w_i q(c_i) = 0 for every q of p's degree.
/// The kernel is conditionally negative definite of order 1, so that a constant p always suffices.
/// If the centres lie in a plane, the affine part of least norm is used. Wendland, Scattered Data
/// Approximation (2005), ch. 8. The system is factored in the constructor; at() may run in
/// parallel.
class Rbf {
 public:
  /// `centres` and `values`: n x 3 each, n >= 1. Throws std::invalid_argument if the sizes differ,
  /// if there are no centres, if a number is not finite, or if the smoothing is negative.
  Rbf(const Points& centres, const Points& values, const RbfOptions& options = {});

  Vec3 at(const Vec3& x) const;
  /// One value per row, computed in parallel.
  Points at_all(const Points& x) const;
  /// Number of centres after merging.
  Eigen::Index centre_count() const { return centres_.rows(); }

 private:
  Points centres_, weights_;
  Eigen::Matrix<double, 4, 3> polynomial_;  // rows: constant, x, y, z
  Vec3 origin_;  // the affine part is relative to the mean of the centres
};

/// The interpolation as a matrix: the values at `places` (rows) are these weights times the values
/// at the first `moving` centres (columns). The values at the other centres are 0.
Eigen::MatrixXd rbf_weights(const Points& centres, Eigen::Index moving, const Points& places);

}  // namespace hyperex
