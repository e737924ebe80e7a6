// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/transform.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hyperex {

Points Similarity::apply(const Points& a) const {
  return ((scale * a) * rotation.transpose()).rowwise() + translation.transpose();
}

Similarity Similarity::inverse() const {
  Similarity inverse;
  inverse.scale = 1 / scale;
  inverse.rotation = rotation.transpose();
  inverse.translation = -inverse.scale * (inverse.rotation * translation);
  return inverse;
}

namespace {

Eigen::VectorXd normalised(const Points& a, const Points& b, const Eigen::VectorXd& weights) {
  if (a.rows() != b.rows() || a.rows() < 1)
    throw std::invalid_argument("a fit needs as many points on one side as on the other");
  if (weights.size() == 0) return Eigen::VectorXd::Constant(a.rows(), 1.0 / double(a.rows()));
  if (weights.size() != a.rows() || !(weights.minCoeff() >= 0) || !(weights.sum() > 0))
    throw std::invalid_argument("weights must be >= 0, one a point, with a positive sum");
  return weights / weights.sum();
}

Similarity fit(const Points& a, const Points& b, const Eigen::VectorXd& weights, bool with_scale) {
  const Eigen::VectorXd w = normalised(a, b, weights);
  if (a.rows() < 3) throw std::invalid_argument("a fit needs three points");
  const Eigen::RowVector3d a_mean = w.transpose() * a, b_mean = w.transpose() * b;
  const Points a0 = a.rowwise() - a_mean, b0 = b.rowwise() - b_mean;
  const Eigen::Matrix3d covariance = b0.transpose() * w.asDiagonal() * a0;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs(1, 1, 1);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs.z() = -1;
  Similarity b_from_a;
  b_from_a.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  const double a_variance = w.dot(a0.rowwise().squaredNorm());
  if (with_scale && a_variance > 0) b_from_a.scale = svd.singularValues().dot(signs) / a_variance;
  b_from_a.translation =
      b_mean.transpose() - b_from_a.scale * (b_from_a.rotation * a_mean.transpose());
  return b_from_a;
}

}  // namespace

Eigen::Isometry3d fit_rigid(const Points& a, const Points& b, const Eigen::VectorXd& weights) {
  const Similarity found = fit(a, b, weights, false);
  Eigen::Isometry3d b_from_a = Eigen::Isometry3d::Identity();
  b_from_a.linear() = found.rotation;
  b_from_a.translation() = found.translation;
  return b_from_a;
}

Similarity fit_similarity(const Points& a, const Points& b, const Eigen::VectorXd& weights) {
  return fit(a, b, weights, true);
}

double rms_distance(const Points& a, const Points& b, const Eigen::VectorXd& weights) {
  return std::sqrt(normalised(a, b, weights).dot((a - b).rowwise().squaredNorm()));
}

double spread_off_line(const Points& points) {
  if (points.rows() < 3) return 0;
  const Eigen::RowVector3d mean = points.colwise().mean();
  const Points centred = points.rowwise() - mean;
  const Eigen::Matrix3d scatter = centred.transpose() * centred;
  const Vec3 squared =  // rising
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  return squared(2) > 0 ? std::sqrt(std::max(squared(1), 0.0) / squared(2)) : 0;
}

}  // namespace hyperex
