// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/left_over.hpp"

#include <algorithm>

#include "hyperex/simulate/drive/principal_directions.hpp"

namespace hyperex::simulate {
namespace {

/// Directions of a part that carry less than this share of the greatest residual are left out.
constexpr double kLeftOverLost = 1e-4;

/// Principal directions of the columns, orthonormal, without those of size `least` or less.
Eigen::MatrixXd directions_of(const Eigen::MatrixXd& columns, double least) {
  const PrincipalDirections all = principal_directions(columns);
  Eigen::Index kept = 0;
  while (kept < all.sizes.size() && all.sizes[kept] > std::max(least, 1e-9)) ++kept;
  return all.directions.leftCols(kept);
}

/// `columns` (3 n x k) times one number per place.
Eigen::MatrixXd scaled_places(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& columns) {
  return numbers.replicate(1, 3).transpose().reshaped().asDiagonal() * columns;
}

}  // namespace

LeftOver divided(const Eigen::MatrixXd& residual, const Eigen::MatrixXd& shares) {
  LeftOver out;
  out.directions.resize(residual.rows(), 0);
  out.course.resize(0, residual.cols());
  const PrincipalDirections whole = principal_directions(residual);
  const double least = whole.sizes.size() > 0 ? kLeftOverLost * whole.sizes[0] : 0;
  for (Eigen::Index part = 0; part < shares.cols(); ++part) {
    const Eigen::MatrixXd own = scaled_places(shares.col(part), residual);
    const Eigen::MatrixXd directions = directions_of(own, least);
    const Eigen::Index kept = out.directions.cols() + directions.cols();
    out.directions.conservativeResize(Eigen::NoChange, kept);
    out.directions.rightCols(directions.cols()) = directions;
    out.course.conservativeResize(kept, Eigen::NoChange);
    out.course.bottomRows(directions.cols()) = directions.transpose() * own;
    out.parts.insert(out.parts.end(), std::size_t(directions.cols()), part);
  }
  return out;
}

}  // namespace hyperex::simulate
