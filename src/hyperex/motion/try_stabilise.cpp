// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/try_stabilise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hyperex/motion/option_error.hpp"

namespace hyperex::motion {

StabilisedMotion with_head_kept(const Motion& motion) {
  return {.motion = motion,
          .pose_points = {},
          .shift_uncertainty_m = {},
          .turn_uncertainty_rad = {},
          .poses = {}};
}

TriedPose try_stabilise(const Motion& motion, const std::vector<std::string>& still_points,
                        const std::string& option) {
  try {
    return {stabilise(motion, {.rigid_points = still_points}), ""};
  } catch (const OptionError& error) {
    return {with_head_kept(motion), error.sentence(option)};
  } catch (const InputError& error) {
    return {with_head_kept(motion), error.what()};
  }
}

std::string still_points_sentence(const std::vector<std::string>& still_points) {
  return fmt::format(
      "head pose: taken out by {}, which keep their distances from each other, as points of the "
      "skull do",
      fmt::join(still_points, ", "));
}

std::string unused_still_points_sentence(const std::vector<std::string>& still_points) {
  return fmt::format(
      "the head's pose is that of the face's landmarks, while {} keep their distances from each "
      "other, as points of the skull do, and are not used",
      fmt::join(still_points, ", "));
}

}  // namespace hyperex::motion
