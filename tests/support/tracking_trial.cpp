// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/tracking_trial.hpp"

#include "hyperex/capture/tum_folder.hpp"
#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::test {

TrialResult run_trial(const std::filesystem::path& folder, const expression::FaceModel& model,
                      const Degradation& degradation, const tracking::TrackerOptions& options) {
  const tracking::Truth truth = tracking::read_truth(folder);
  const auto source =
      degraded(capture::open_tum_folder(folder, {.read_ahead_frames = 0}), degradation);
  const tracking::Tracking tracked = tracking::track(*source, model, options);
  TrialResult result;
  tracking::Truth kept;
  for (std::size_t k = 0; k < truth.time_s.size(); ++k) {
    if (degradation.spoils(k)) {
      ++result.spoiled;
      continue;
    }
    kept.time_s.push_back(truth.time_s[k]);
    kept.camera_from_face.push_back(truth.camera_from_face[k]);
    kept.landmarks_m.push_back(truth.landmarks_m[k]);
    if (!truth.jaw_open.empty()) kept.jaw_open.push_back(truth.jaw_open[k]);
  }
  for (const auto& frame : tracked.frames)
    if (degradation.spoils(frame.index) && !frame.valid) ++result.given_up;
  result.score = tracking::score(model, tracked.frames, kept);
  return result;
}

std::vector<Trial> standard_trials(std::size_t frames) {
  return {
      {"As recorded", "", {}},
      {"Colour only", "The depth is left out.", {.without_depth = true}},
      {"Depth with holes",
       "30 % of the depth's pixels lose their reading, others in each frame.",
       {.depth_holes = 0.3}},
      {"Ten black frames",
       "Ten frames in the middle show nothing; their depth stays.",
       {.black = {frames / 2, 10}}},
      {"The face leaves and comes back",
       "In the middle third of the frames the picture slides out of view, stays out and comes "
       "back.",
       {.away = {frames / 3, frames / 3}}},
      {"Dark and noisy",
       "Half the brightness, and noise of 8 levels (standard deviation) in each channel.",
       {.brightness = 0.5, .noise_levels = 8}},
  };
}

}  // namespace hyperex::test
