// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Tracking scored on recordings with truth, as recorded and made worse.
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/tracking/fit/score.hpp"
#include "support/degraded_source.hpp"

namespace hyperex::test {

struct TrialResult {
  /// Over the frames that the degradation does not spoil; `lost` counts among them.
  tracking::Score score;
  std::size_t spoiled = 0;   ///< frames that it does (Degradation::spoils)
  std::size_t given_up = 0;  ///< of them, said to be not valid
};

/// Tracks a recording (a TUM folder with truth files) with `degradation` done to it.
TrialResult run_trial(const std::filesystem::path& folder, const expression::FaceModel& model,
                      const Degradation& degradation = {},
                      const tracking::TrackerOptions& options = {});

struct Trial {
  std::string name, what;  ///< a heading, and a sentence on what is done
  Degradation degradation;
};

/// The conditions in which tracking must go on, for a recording of so many frames.
std::vector<Trial> standard_trials(std::size_t frames);

}  // namespace hyperex::test
