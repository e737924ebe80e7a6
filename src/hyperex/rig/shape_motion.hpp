// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::rig {

/// An expression: weights of ARKit's blend shapes, and a time at which the face shows it.
struct Pose {
  std::vector<std::pair<std::string, double>> weights;
  double time_s = 0;
};

/// The motion of the canonical face's landmarks through the poses, in its frame and size: one pose
/// per second, reached after 0.4 s and held for 0.4 s, with rest between. Sets time_s of each pose
/// to the end of its hold. Each shape moves the landmarks as that of its name does in the shapes of
/// real faces (expression/shape_model.hpp; browInnerUp and cheekPuff are those of both sides). Lids
/// move as by the canonical face's own units (expression/face_model.hpp), which close and widen its
/// eyes exactly and follow a gaze up or down. A gaze aside and the tongue move nothing.
motion::Motion motion_through(std::vector<Pose>& poses);

}  // namespace hyperex::rig
