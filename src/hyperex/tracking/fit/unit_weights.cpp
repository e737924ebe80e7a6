// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/unit_weights.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/assert.hpp"
#include "hyperex/tracking/model/lips.hpp"
#include "hyperex/tracking/model/unit_matrix.hpp"

namespace hyperex::tracking {

namespace {

constexpr int kMostSweeps = 20000;
constexpr double kSettled = 1e-9;  // largest change of a weight in a sweep

/// A small turn (about the points' mean) and shift, 3 |V| x 6.
Eigen::MatrixXd rigid_motions(const Points& points) {
  const Eigen::RowVector3d middle = points.colwise().mean();
  Eigen::MatrixXd motions(3 * points.rows(), 6);
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const Vec3 y = (points.row(v) - middle).transpose();
    motions.block<3, 3>(3 * v, 0) << 0, y.z(), -y.y(), -y.z(), 0, y.x(), y.y(), -y.x(), 0;
    motions.block<3, 3>(3 * v, 3).setIdentity();
  }
  return motions;
}

/// 1 / s_v of each coordinate.
Eigen::VectorXd precision(const FaceModel& model, const UnitMatrix& units,
                          const UnitReaderOptions& options) {
  const UnitMatrix typical = units * typical_weights(model).asDiagonal();
  const std::vector<bool> lip = within_lips(model);
  Eigen::VectorXd inverse(units.rows());
  for (Eigen::Index v = 0; v < model.vertex_count(); ++v) {
    const double off = options.off_units_share * typical.middleRows<3>(3 * v).norm();
    const double variance = options.noise_m * options.noise_m + off * off +
                            (lip[std::size_t(v)] ? std::pow(options.off_units_lip_m, 2) : 0);
    inverse.segment<3>(3 * v).setConstant(1 / std::sqrt(variance));
  }
  return inverse;
}

}  // namespace

UnitReader::UnitReader(const FaceModel& model, const Points& neutral_m, double unit_scale,
                       const UnitReaderOptions& options)
    : neutral_m_(neutral_m) {
  HX_ASSERT(neutral_m.rows() == model.vertex_count() && unit_scale > 0);
  const UnitMatrix units = unit_scale * unit_matrix(model);
  const double mean = 1 / std::sqrt(double(neutral_m.rows()));
  const Eigen::VectorXd inverse = mean * precision(model, units, options);
  // Whitened, and their rigid part taken out: what is left of d does not know of it.
  Eigen::MatrixXd moved = inverse.asDiagonal() * units;
  const Eigen::MatrixXd rigid = inverse.asDiagonal() * rigid_motions(neutral_m);
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(rigid).householderQ() *
                                Eigen::MatrixXd::Identity(rigid.rows(), rigid.cols());
  moved -= basis * (basis.transpose() * moved);
  hessian_ = moved.transpose() * moved;
  gradient_ = moved.transpose() * inverse.asDiagonal();
  cost_ = options.sparseness * hessian_.diagonal().cwiseSqrt();
  hessian_.diagonal().array() += (options.shrinkage / typical_weights(model).array()).square();
  most_ = Eigen::VectorXd::Constant(units.cols(), options.most);
  least_ = Eigen::VectorXd::Zero(units.cols());
  for (Eigen::Index k = 0; k < units.cols(); ++k)
    if (!model.animation_units[std::size_t(k)].arkit_negative.empty()) least_[k] = -options.most;
}

Eigen::VectorXd UnitReader::read(const Points& vertices_m) const {
  HX_ASSERT(vertices_m.rows() == neutral_m_.rows());
  const Points moved = vertices_m - neutral_m_;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(hessian_.rows());
  // Of the quadratic part, kept up to date; one weight at a time is then moved to its best.
  Eigen::VectorXd slope =
      -gradient_ * Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size());
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double largest = 0;
    for (Eigen::Index k = 0; k < weights.size(); ++k) {
      const double curve = hessian_(k, k), free = weights[k] - slope[k] / curve,
                   cost = cost_[k] / curve;
      const double best = std::clamp(free > cost    ? free - cost
                                     : free < -cost ? free + cost
                                                    : 0.0,
                                     least_[k], most_[k]);
      if (best == weights[k]) continue;
      slope += (best - weights[k]) * hessian_.col(k);
      largest = std::max(largest, std::abs(best - weights[k]));
      weights[k] = best;
    }
    if (largest < kSettled) break;
  }
  return weights;
}

}  // namespace hyperex::tracking
