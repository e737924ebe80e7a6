// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/try_stabilise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hyperex/core/add_rest.hpp"
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

std::string still_points_sentence(const StillPoints& still_points) {
  constexpr std::size_t most_named = 8;
  std::string sentence = fmt::format("the head is held by {}, which keep still against each other",
                                     fmt::join(still_points.names, ", "));
  std::vector<std::string> not_used;
  for (const UnsteadyPoint& point : still_points.left_out)
    if (not_used.size() < most_named)
      not_used.push_back(
          fmt::format("{} (moves by {:.1f} mm against them)", point.name, 1e3 * point.change_m));
  add_rest(not_used, still_points.left_out.size());
  if (!not_used.empty()) sentence += fmt::format("; not used: {}", fmt::join(not_used, ", "));
  return sentence;
}

std::string unused_still_points_sentence(const std::vector<std::string>& still_points) {
  return fmt::format(
      "the head's pose is that of the face's landmarks, while {} keep still against each other, as "
      "points of the skull do, and are not used",
      fmt::join(still_points, ", "));
}

}  // namespace hyperex::motion
