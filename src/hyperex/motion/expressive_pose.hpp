// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "hyperex/motion/motion.hpp"
#include "hyperex/motion/uncertain_pose.hpp"

namespace hyperex::motion {

/// A landmark that is both in a motion and in the table landmark_motion().
struct KnownLandmark {
  int column = 0;  ///< of the motion
  int row = 0;     ///< of the table
};

/// All such landmarks that are measured in sample 0. A place that has two names occurs once.
std::vector<KnownLandmark> known_landmarks(const Motion& motion);

/// Head pose of each sample from all landmarks, with the expression of the face marginalised out.
/// With x the landmarks of sample 0, y those of sample k and J the derivative with respect to the
/// pose,
///
///   T^-1 y = x + e + n,  e ~ N(0, u^2 C_upper + l^2 C_lower),  n ~ N(0, 2 s^2 I)
///   pose: generalised least squares,  covariance (J' S^-1 J)^-1,  S = u^2 C_upper + l^2 C_lower +
///   2 s^2 I
///
/// C_upper and C_lower come from landmark_motion.hpp. The amplitudes u and l of the expression are
/// estimated for each sample by restricted maximum likelihood (Patterson and Thompson, Biometrika
/// 58 (1971)). They are then smoothed over time (Gaussian, 0.1 s), so that the pose is as smooth as
/// the points. The jitter s of a coordinate comes from the motion's fourth differences (jitter.hpp)
/// and is at least 0.0001 mm. At rest u and l are small, and all landmarks have weight. Where the
/// brows rise, u is large and the lower face determines the pose; where the mouth moves, it is the
/// other way round. Between amplitudes that are powers of two the estimate is interpolated. The
/// covariance is computed with l at least u and u at least l / 2: a motion of the brows that was
/// taken for a motion of the head leaves no trace in the lower face, and the reverse. `landmarks`:
/// those of known_landmarks(). Each sample must have three or more of them that are not on a line.
std::vector<UncertainPose> expressive_poses(const Motion& motion,
                                            const std::vector<KnownLandmark>& landmarks);

/// The same for samples that arrive one after another. The amplitudes of the expression are
/// smoothed over the past samples alone, the jitter is given, and no covariance is computed.
class ExpressivePoseStream {
 public:
  /// `reference`: its names are those of the points, its first sample is the face at rest. Throws
  /// InputError where fewer than three landmarks are known.
  ExpressivePoseStream(Motion reference, double jitter_m);
  ~ExpressivePoseStream();
  ExpressivePoseStream(ExpressivePoseStream&&) noexcept;
  ExpressivePoseStream& operator=(ExpressivePoseStream&&) noexcept;

  /// Maps the head at rest to its place in `positions` (P x 3, finite). `time_s` must rise from
  /// call to call.
  Eigen::Isometry3d pose(double time_s, const Points& positions);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::motion
