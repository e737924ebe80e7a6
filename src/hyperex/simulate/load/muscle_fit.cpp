// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/muscle_fit.hpp"

#include <algorithm>
#include <limits>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/muscles/bounded_least_squares.hpp"

namespace hyperex::simulate {
namespace {
constexpr int kMostIterations = 8;
}

Eigen::Matrix<double, 12, 1> JawKinematics::motion(const JawPose& p) const {
  const face::FaceFrame& axes = hinge_.frame;
  const Eigen::Matrix3d turn = hinge_.turned(p[0], p[1], p[2]) - Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 12, 1> out;
  out.head<9>() = turn.reshaped();
  out.tail<3>() = -turn * hinge_.centre + p[3] * axes.x + p[4] * axes.y + p[5] * axes.z;
  return out;
}

Eigen::Matrix<double, 12, 6> JawKinematics::derivative(const JawPose& pose) const {
  return central_differences([this](const JawPose& p) { return motion(p); }, pose);
}

MuscleFit::MuscleFit(PointResponse response, const JawKinematics& jaw, const FitPriors& priors,
                     double sigma_m, std::vector<char> tone, std::vector<char> ring)
    : response_(std::move(response)),
      jaw_(jaw),
      priors_(priors),
      sigma_m_(sigma_m),
      tone_(std::move(tone)),
      ring_(std::move(ring)) {
  last_.activation = Eigen::VectorXd::Zero(response_.of_muscles.cols());
  if (priors_.correlation.size() > 0) precision_ = priors_.correlation.inverse();
}

/// The columns at the activations of the last answer.
Eigen::MatrixXd MuscleFit::blend(const Eigen::MatrixXd& narrow, const Eigen::MatrixXd& wide) const {
  if (wide.cols() == 0) return narrow;
  const Eigen::RowVectorXd share =
      last_.activation.unaryExpr([&](double a) { return response_.wide_share(a); }).transpose();
  return narrow + (wide - narrow) * share.asDiagonal();
}

/// Before a point is seen, at the signs and the jaw's opening of the last answer.
Eigen::VectorXd MuscleFit::sigmas() const {
  Eigen::VectorXd out(response_.of_muscles.cols());
  const double opening = std::max(0.0, last_.jaw[0]);
  for (Eigen::Index m = 0; m < out.size(); ++m) {
    out[m] = tone_[m] && last_.activation[m] < 0 ? priors_.tone
             : ring_[m]                          ? priors_.ring
                                                 : priors_.activation;
    if (priors_.readiness.size() > 0) out[m] *= priors_.readiness[m];
    if (priors_.yields.size() > 0) out[m] /= 1 + priors_.yields[m] * opening;
  }
  return out;
}

/// Of the activations before a point is seen.
Eigen::MatrixXd MuscleFit::prior_covariance(const Eigen::VectorXd& sigma) const {
  if (priors_.correlation.size() == 0) return sigma.cwiseAbs2().asDiagonal();
  return sigma.asDiagonal() * priors_.correlation * sigma.asDiagonal();
}

/// The inverse of the activations' covariance before a point is seen.
void MuscleFit::add_priors(Eigen::MatrixXd& h) const {
  const Eigen::VectorXd one_over = sigmas().cwiseInverse();
  const Eigen::Index n = one_over.size();
  if (precision_.size() == 0)
    h.topLeftCorner(n, n).diagonal() += one_over.cwiseAbs2();
  else
    h.topLeftCorner(n, n) += one_over.asDiagonal() * precision_ * one_over.asDiagonal();
}

FitResult MuscleFit::fit(const Eigen::VectorXd& displacement) {
  const Eigen::Index muscles = response_.of_muscles.cols(), all = muscles + 6;
  const double weight = 1 / sigma_m_;
  JawPose prior;
  prior << priors_.opening_rad, priors_.turn_rad, priors_.tilt_rad, priors_.slide_m;
  Eigen::VectorXd lower = Eigen::VectorXd::Zero(all);
  lower.tail<6>().setConstant(-std::numeric_limits<double>::infinity());
  for (Eigen::Index m = 0; m < muscles; ++m)
    if (tone_[m]) lower[m] = -std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const Eigen::MatrixXd jaw = weight * response_.of_jaw * jaw_.derivative(last_.jaw);
    const Eigen::VectorXd right =
        weight * (displacement - response_.of_jaw * jaw_.motion(last_.jaw)) + jaw * last_.jaw;
    const Eigen::MatrixXd pulls = weight * blend(response_.of_muscles, response_.of_wide);
    Eigen::MatrixXd h(all, all);
    h.topLeftCorner(muscles, muscles).noalias() = pulls.transpose() * pulls;
    h.topRightCorner(muscles, 6) = pulls.transpose() * jaw;
    h.bottomLeftCorner(6, muscles) = h.topRightCorner(muscles, 6).transpose();
    h.bottomRightCorner(6, 6) = jaw.transpose() * jaw;
    add_priors(h);
    const Eigen::VectorXd sigma = sigmas();  // before the activations change
    for (int k = 0; k < 6; ++k) h(muscles + k, muscles + k) += 1 / (prior[k] * prior[k]);
    Eigen::VectorXd g(all), x(all);
    g << pulls.transpose() * right, jaw.transpose() * right;
    x << last_.activation, last_.jaw;
    muscles::bounded_least_squares(h, g, lower, x);
    const double change = (x.head(muscles) - last_.activation).cwiseAbs().maxCoeff() +
                          (x.tail<6>() - last_.jaw).cwiseAbs().maxCoeff();
    last_.activation = x.head(muscles);
    last_.jaw = x.tail<6>();
    if (change < 1e-6 || iteration == kMostIterations - 1) {
      last_.prior_covariance = prior_covariance(sigma);
      last_.covariance =
          h.llt().solve(Eigen::MatrixXd::Identity(all, all)).topLeftCorner(muscles, muscles);
      break;
    }
  }
  last_.left_over = displacement -
                    blend(response_.of_muscles, response_.of_wide) * last_.activation -
                    response_.of_jaw * jaw_.motion(last_.jaw);
  return last_;
}

}  // namespace hyperex::simulate
