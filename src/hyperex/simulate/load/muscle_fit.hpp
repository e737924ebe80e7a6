// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/simulate/drive/jaw.hpp"

namespace hyperex::simulate {

/// The pose of the mandible: opening about the axis through the condyles, turn to the side, tilt
/// (rad), then the slide along the face's axes (m).
using JawPose = Eigen::Matrix<double, 6, 1>;

/// The jaw's displacement for a pose: turn (9 numbers, column by column) and slide (3) of
/// Boundary::JawMotion.
class JawKinematics {
 public:
  explicit JawKinematics(const io::Landmarks& landmarks, const anatomy::Bones* bones)
      : hinge_(landmarks, bones) {}
  Eigen::Matrix<double, 12, 1> motion(const JawPose& pose) const;
  Eigen::Matrix<double, 12, 6> derivative(const JawPose& pose) const;

 private:
  JawHinge hinge_;
};

/// Standard deviations (1 sigma) of the fitted numbers before any point is observed.
struct FitPriors {
  double activation = 0.2;
  double ring = 0.2;  ///< muscles that act as rings
  double tone = 0.1;  ///< below rest, of muscles that may relax
  double opening_rad = 0.35, turn_rad = 0.03, tilt_rad = 0.02;
  Vec3 slide_m = Vec3::Constant(0.002);  ///< of the jaw: aside, up and forward
  /// Per muscle: a factor on activation, ring and tone; empty: all 1.
  Eigen::VectorXd readiness = {};
  /// Per muscle: divides the factor by 1 + yields * opening (rad of jaw opening), since an open jaw
  /// explains the motion by itself; empty: all 0.
  Eigen::VectorXd yields = {};
  Eigen::MatrixXd correlation = {};  ///< between the activations; empty: none
};

/// How points move with activations and with the jaw: 3 P x M and 3 P x 12, m. With wide bands a
/// muscle of activation a moves them by a ((1 - w) of_muscles + w of_wide), w = wide_share(a).
struct PointResponse {
  Eigen::MatrixXd of_muscles, of_jaw, of_wide;
  double half = 0.5;  ///< activation at which half of the force acts in the wide band
  double wide_share(double a) const { return a > 0 ? a / (a + half) : 0; }
};

struct FitResult {
  Eigen::VectorXd activation;
  JawPose jaw = JawPose::Zero();
  Eigen::MatrixXd covariance;  ///< of the activations, without regard to their bounds
  /// The same before a point is seen, at the signs and the jaw's opening of this answer.
  Eigen::MatrixXd prior_covariance;
  Eigen::VectorXd left_over;  ///< observed less modelled, 3 P, m
};

/// Fits activations and the jaw's pose to displacements of points.
class MuscleFit {
 public:
  /// `sigma_m`: 1 sigma of the error of a coordinate. `tone[m]`: muscle m may go below 0.
  /// `ring[m]`: it acts as a ring.
  MuscleFit(PointResponse response, const JawKinematics& jaw, const FitPriors& priors,
            double sigma_m, std::vector<char> tone, std::vector<char> ring);
  /// `displacement` of the points: 3 P, m. The search starts from the last answer.
  FitResult fit(const Eigen::VectorXd& displacement);
  double wide_share(double activation) const { return response_.wide_share(activation); }

 private:
  PointResponse response_;
  JawKinematics jaw_;
  FitPriors priors_;
  double sigma_m_;
  std::vector<char> tone_, ring_;
  Eigen::MatrixXd precision_;  ///< the inverse of the correlations
  Eigen::MatrixXd blend(const Eigen::MatrixXd& narrow, const Eigen::MatrixXd& wide) const;
  Eigen::VectorXd sigmas() const;
  Eigen::MatrixXd prior_covariance(const Eigen::VectorXd& sigma) const;
  void add_priors(Eigen::MatrixXd& h) const;
  FitResult last_;
};

}  // namespace hyperex::simulate
