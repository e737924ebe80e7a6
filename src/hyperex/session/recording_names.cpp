// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/recording_names.hpp"

#include <algorithm>
#include <iterator>

#include "hyperex/core/error.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/motion/option_error.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/session/cleaned_recording.hpp"
#include "hyperex/simulate/drive/common_points.hpp"

namespace hyperex::session {
namespace {

/// The motion without the samples in which no point is measured, which a run fills.
motion::Motion without_lost_samples(const motion::Motion& motion) {
  motion::Motion out = motion;
  out.time_s.clear();
  out.positions.clear();
  out.lines.clear();
  for (std::size_t k = 0; k < motion.positions.size(); ++k) {
    if (motion.positions[k].array().isNaN().all()) continue;
    out.time_s.push_back(motion.time_s[k]);
    out.positions.push_back(motion.positions[k]);
    if (k < motion.lines.size()) out.lines.push_back(motion.lines[k]);
  }
  return out;
}

}  // namespace

void check_head_points(const motion::Motion& motion, const std::vector<std::string>& rigid_points) {
  try {
    motion::check_pose_points(motion, rigid_points);
  } catch (const motion::OptionError& error) {
    std::string sentence = error.sentence("motion.rigid_points");
    if (motion::proposed_rigid_points(motion).empty())
      sentence +=
          "; hyperex symmetry works without them, and its excursions then contain the motion of "
          "the head";
    throw InputError(sentence);
  }
}

void check_landmark_names(const motion::Motion& motion) {
  constexpr std::size_t fewest = 3;
  const auto& landmarks = face::canonical_face().landmarks;
  std::vector<std::string> shared;
  std::ranges::copy_if(motion.names, std::back_inserter(shared),
                       [&](const std::string& name) { return landmarks.contains(name); });
  if (shared.size() < fewest) throw simulate::too_few_common(motion, shared);
}

std::vector<std::string> doubts_of_names(const motion::Motion& motion,
                                         const std::vector<std::string>& rigid_points) {
  std::vector<std::string> doubts;
  const auto collect = [&](const auto& check) {
    try {
      check();
    } catch (const InputError& error) {
      doubts.emplace_back(error.what());
    }
  };
  collect([&] { check_head_points(motion, rigid_points); });
  collect([&] { check_landmark_names(motion); });
  return doubts;
}

motion::StillPoints points_to_hold_the_head(const motion::Motion& recorded) {
  try {
    return motion::points_to_hold_the_head(
        without_lost_samples(cleaned_recording(recorded).motion));
  } catch (const InputError&) {  // a check reports it
    return motion::points_to_hold_the_head(recorded);
  }
}

}  // namespace hyperex::session
