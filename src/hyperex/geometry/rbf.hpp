// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The polynomial beside the kernels: what is reproduced exactly everywhere.
enum class RbfPolynomial { constant, affine };

struct RbfOptions {
  RbfPolynomial polynomial = RbfPolynomial::constant;
  /// >= 0, length: 0 meets the data, more follows them less closely (ridge on the kernel matrix).
  double smoothing = 0;
  /// Centres no farther apart than this are one, at their mean, with the mean of their values.
  double merge_distance = 1e-9;
};

/// Interpolation of vectors given at scattered points by the linear kernel (biharmonic in 3D):
///   s(x) = sum_i w_i |x - c_i| + p(x),  sum_i w_i q(c_i) = 0 for every q of p's degree.
/// The kernel is conditionally negative definite of order 1, so the constant always suffices; the
/// affine part of centres in one plane is the one of least norm. Wendland, Scattered Data
/// Approximation (2005), ch. 8. Factored at construction; at() may run in parallel.
class Rbf {
 public:
  /// `centres` and `values`: n x 3 each, n >= 1. Throws std::invalid_argument where the sizes
  /// differ, nothing is given, a number is not finite or the smoothing is negative.
  Rbf(const Points& centres, const Points& values, const RbfOptions& options = {});

  Vec3 at(const Vec3& x) const;
  /// One value per row, computed in parallel.
  Points at_all(const Points& x) const;
  /// Centres left after merging.
  Eigen::Index centre_count() const { return centres_.rows(); }

 private:
  Points centres_, weights_;
  Eigen::Matrix<double, 4, 3> polynomial_;  // rows: constant, x, y, z
  Vec3 origin_;                             // the affine part is about the centres' mean
};

/// Interpolated values at `places` as weights (rows) of those at the first `moving` centres
/// (columns), the others' being 0.
Eigen::MatrixXd rbf_weights(const Points& centres, Eigen::Index moving, const Points& places);

}  // namespace hyperex
