// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"
#include "hyperex/motion/uncertain_pose.hpp"

namespace hyperex::motion {

struct StabiliseOptions {
  /// Points that move with the skull alone. Empty: all landmarks of the face, each weighted by how
  /// much it moves in real faces (expressive_pose.hpp).
  std::vector<std::string> rigid_points;
  /// Rounds of reweighting of the given points. A point whose residuals over the whole motion are
  /// larger than usual gets a smaller Cauchy weight. Each point has one weight for all times, so
  /// that the pose stays as smooth as its input. 0: all points have the same weight.
  int reweightings = 10;
};

/// A motion without its head pose.
struct StabilisedMotion {
  Motion motion;                         ///< in the frame of sample 0, with head_pose set
  std::vector<std::string> pose_points;  ///< the points from which the pose was estimated
  /// 95 % bounds of each sample: how far an error of the pose may shift the motion's points (root
  /// mean square over them), and how far it may rotate the head. Where the pose comes from the
  /// landmarks of the face, the bounds include the errors that an expression may cause. Where it
  /// comes from given points, the bounds are computed from their residuals alone: points that move
  /// together as the head would are not detected. 0 for sample 0.
  std::vector<double> shift_uncertainty_m, turn_uncertainty_rad;
  /// The pose of each sample, with the covariance that belongs to these bounds.
  std::vector<UncertainPose> poses;
};

/// A pose needs at least three of these points in every sample, not on a line: the eye corners, the
/// bridge of the nose and the outline of the face beside the eyes, by iBUG-68 and anatomical name.
/// The outline lies farther back, so that the points spread in depth. The tip of the nose is added
/// where those of them that a motion has lie close to a line, as the eye corners alone do.
const std::vector<std::string>& default_rigid_points();

/// Throws as stabilise() would before any work: InputError where a given point does not exist,
/// OptionError on `rigid_points` where fewer than three points can carry the pose. Given points of
/// the mouth and the chin (face::moves_with_mouth()) do not count.
void check_pose_points(const Motion& motion, const std::vector<std::string>& rigid_points = {});

/// For each sample k, head_pose[k] is the rigid transform that maps the head of sample 0 to sample
/// k. Positions become head_pose[k]^-1 positions[k], so that only deformation is left; head_pose[0]
/// is the identity. `skull_points` are the given ones. The pose is estimated from all landmarks of
/// the face (expressive_pose.hpp), or from the given points (Kabsch, no scale). Points not measured
/// stay NaN. Throws as check_pose_points() does, and InputError where in some sample fewer than
/// three rigid points are measured or they lie nearly on a line.
StabilisedMotion stabilise(const Motion& motion, const StabiliseOptions& options = {});

/// For a motion whose head is known to be still, such as that of a face model moved by expressions:
/// the identity in every sample, without uncertainty.
StabilisedMotion with_still_head(const Motion& motion);

}  // namespace hyperex::motion
