// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

struct StabiliseOptions {
  /// Points that move with the skull alone; empty: all landmarks of the face, each weighed by how
  /// much it moves in life (expressive_pose.hpp).
  std::vector<std::string> rigid_points;
  /// Rounds of reweighting of stated points: one whose residuals over the whole motion are larger
  /// than usual counts less (Cauchy weights, one per point: the same at all times, so that the pose
  /// stays as smooth as its input). 0: all count the same.
  int reweightings = 10;
};

/// Head pose taken out of a motion.
struct StabilisedMotion {
  Motion motion;                         ///< in the frame of sample 0, with head_pose set
  std::vector<std::string> pose_points;  ///< those that the pose was found from
  /// A sample each, 95 % bounds: how far an error of the pose may shift the motion's points (root
  /// mean square over them), and turn the head. Of landmarks of the face they contain what an
  /// expression may hide; of stated points only what their residuals show: points that move
  /// together as the head would are not noticed. 0 for sample 0.
  std::vector<double> shift_uncertainty_m, turn_uncertainty_rad;
};

/// What a pose needs at least three of at every sample, not on a line: eye corners, the bridge of
/// the nose and the outline of the face beside the eyes (which gives the pose an arm in depth), by
/// iBUG-68 and anatomical name. The tip of the nose is added where a motion's own of these lie
/// close to a line, as eye corners alone do.
const std::vector<std::string>& default_rigid_points();

/// Per sample k the rigid transform head_pose[k] that carries the head of sample 0 to sample k;
/// positions become head_pose[k]^-1 positions[k], so that only deformation is left, and
/// head_pose[0] is the identity. From all landmarks of the face (expressive_pose.hpp), or from
/// stated points (Kabsch, no scale). Points not measured stay NaN.
/// Throws InputError where a stated point does not exist, or at some sample fewer than three
/// rigid points are measured or those lie nearly on a line.
StabilisedMotion stabilise(const Motion& motion, const StabiliseOptions& options = {});

/// A motion whose head is known to be still, as that of a face model that expressions move: the
/// identity at every sample, without uncertainty.
StabilisedMotion with_still_head(const Motion& motion);

}  // namespace hyperex::motion
