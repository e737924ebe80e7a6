// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/estimate/face_model.hpp"
#include "hyperex/estimate/unknowns.hpp"

namespace hyperex::estimate {

/// The displacement of points in one recording as the face model has it, with its derivative.
///
/// Under a known load f the tissue's stiffness matrix is exp(y - t) K(t), with y = ln E / E_scene
/// and t the same relative to the support: the points move by exp(t - y) C(t) R f, where C(t) are
/// FaceResponses' columns of the load and R turns it, before and while it acts, by errors of
/// direction.
///
/// Muscles' forces are relative to the tissue's stiffness, so that y does not matter. With
/// the activation a of a muscle, its gain g and the half h of MuscleOptions::half, its narrow band
/// acts by g a h / (a + h) and its wide band by g a^2 / (a + h); below 0 the narrow band alone.
class RecordingModel {
 public:
  /// `face` must outlive this.
  /// `loads`: Observation::load of each recording.
  RecordingModel(FaceModel& face, const Unknowns& unknowns, std::vector<int> loads);

  /// 3 P, m. Sets the face's stiffness to that of `x`.
  Eigen::VectorXd displacement(const Eigen::VectorXd& x, Eigen::Index recording);
  /// Its derivative by all of `x`.
  Eigen::MatrixXd derivative(const Eigen::VectorXd& x, Eigen::Index recording);
  const Unknowns& unknowns() const { return unknowns_; }

 private:
  Vec3 turned_load(const Eigen::VectorXd& x, Eigen::Index recording) const;
  Eigen::VectorXd under_load(const Eigen::VectorXd& x, Eigen::Index recording) const;
  Eigen::MatrixXd derivative_under_load(const Eigen::VectorXd& x, Eigen::Index recording);
  Acting acting(const Eigen::VectorXd& x, Eigen::Index recording) const;
  Eigen::VectorXd gains(const Eigen::VectorXd& x, Eigen::Index without = -1) const;

  FaceModel& face_;
  Unknowns unknowns_;
  std::vector<int> loads_;
  Eigen::MatrixXd head_;  ///< 3 P x 6
};

}  // namespace hyperex::estimate
