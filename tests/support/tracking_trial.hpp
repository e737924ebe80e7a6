// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scores of tracking on recordings with truth, as recorded and with added faults.
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/tracking/fit/score.hpp"
#include "support/degraded_source.hpp"

namespace hyperex::test {

struct TrialResult {
  /// Over the frames that the degradation does not spoil, including those in which tracking was
  /// lost.
  tracking::Score score;
  std::size_t spoiled = 0;   ///< number of frames that it spoils (Degradation::spoils)
  std::size_t given_up = 0;  ///< number of these that the tracker marks as not valid
};

/// Tracks a recording (a TUM folder with truth files) with `degradation` applied.
TrialResult run_trial(const std::filesystem::path& folder, const expression::FaceModel& model,
                      const Degradation& degradation = {},
                      const tracking::TrackerOptions& options = {});

struct Trial {
  std::string name, what;  ///< a heading, and a sentence about the degradation
  Degradation degradation;
};

/// The conditions under which tracking must go on, for a recording of this number of frames.
std::vector<Trial> standard_trials(std::size_t frames);

}  // namespace hyperex::test
