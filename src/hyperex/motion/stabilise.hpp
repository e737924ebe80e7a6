// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

struct StabiliseOptions {
  /// Points that move with the skull alone; empty: default_rigid_points() that the motion has.
  std::vector<std::string> rigid_points;
  /// Rounds of reweighting: a rigid point whose residuals over the whole motion are larger than
  /// usual counts less (Cauchy weights, one a point: the same at all times, so that the pose stays
  /// as smooth as its input). 0: all count the same.
  int reweightings = 10;
};

/// Head pose taken out of a motion.
struct StabilisedMotion {
  Motion motion;                          ///< in the frame of sample 0, with head_pose set
  std::vector<std::string> rigid_points;  ///< those used
  Eigen::VectorXd weights;                ///< of those, largest 1
  std::vector<double> rms_residual_m;     ///< per sample, weighted, over the rigid points
};

/// Eye corners, the bridge of the nose and the outline of the face beside the eyes (which gives the
/// pose an arm in depth), by iBUG-68 and anatomical name. The tip of the nose is added where a
/// motion's own of these lie close to a line, as eye corners alone do.
const std::vector<std::string>& default_rigid_points();

/// Per sample k the rigid transform head_pose[k] (Kabsch, no scale) that carries the rigid points
/// of sample 0 onto those of sample k; positions become head_pose[k]^-1 positions[k], so that only
/// deformation is left, and head_pose[0] is the identity. Points not measured stay NaN.
/// Throws InputError where a stated point does not exist, or at some sample fewer than three
/// rigid points are measured or those lie nearly on a line.
StabilisedMotion stabilise(const Motion& motion, const StabiliseOptions& options = {});

}  // namespace hyperex::motion
