// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// A pose of the head in one sample and how well it is known.
struct UncertainPose {
  /// Carries points of the head in sample 0 to where they are now.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Covariance of the error: a rotation (rad) about `centre` and a shift (m), in the axes of
  /// sample 0.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  Vec3 centre = Vec3::Zero();  ///< in sample 0
};

/// A landmark of the table landmark_motion() that a motion has.
struct KnownLandmark {
  int column = 0;  ///< of the motion
  int row = 0;     ///< of the table
};

/// Those measured in sample 0, a place that has two names once.
std::vector<KnownLandmark> known_landmarks(const Motion& motion);

/// Head pose of each sample from all landmarks, the expression of the face marginalised out: with
/// x the landmarks of sample 0, y those of sample k and J the derivative by the pose,
///
///   T^-1 y = x + e + n,  e ~ N(0, u^2 C_upper + l^2 C_lower),  n ~ N(0, 2 s^2 I)
///   pose: generalised least squares,  covariance (J' S^-1 J)^-1,  S = u^2 C_upper + l^2 C_lower +
///   2 s^2 I
///
/// C from landmark_motion.hpp. How strong the expression is, u and l, is found for each sample by
/// restricted maximum likelihood (Patterson and Thompson, Biometrika 58 (1971)), then smoothed over
/// time (Gaussian, 0.1 s), so that the pose is as smooth as the points. The jitter s of a
/// coordinate comes from the motion's fourth differences (jitter.hpp) and is at least 0.0001 mm. At
/// rest u and l are small and all landmarks count; where brows rise, u is large and the lower face
/// carries the pose, and the other way round. The covariance is worked out with l at least u: what
/// of raised brows is taken for the head's leaves no trace in the lower face. `landmarks`: those of
/// known_landmarks(), three or more in each sample and not on a line.
std::vector<UncertainPose> expressive_poses(const Motion& motion,
                                            const std::vector<KnownLandmark>& landmarks);

/// The same for samples that come in one after the other: how strong the expression is is smoothed
/// over the samples so far alone, and the jitter is stated. Covariances are left out.
class ExpressivePoseStream {
 public:
  /// `reference`: names and the face at rest, its first sample. Throws InputError where fewer than
  /// three landmarks are known.
  ExpressivePoseStream(Motion reference, double jitter_m);
  ~ExpressivePoseStream();
  ExpressivePoseStream(ExpressivePoseStream&&) noexcept;
  ExpressivePoseStream& operator=(ExpressivePoseStream&&) noexcept;

  /// Carries the head at rest to where it is in `positions` (P x 3, finite). Times rise.
  Eigen::Isometry3d pose(double time_s, const Points& positions);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::motion
