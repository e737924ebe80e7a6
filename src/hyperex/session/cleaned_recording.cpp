// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/cleaned_recording.hpp"

#include <algorithm>
#include <utility>

#include "hyperex/motion/wild_samples.hpp"
#include "hyperex/session/reading_warnings.hpp"

namespace hyperex::session {
namespace {

/// The motion as it was, with its wild readings as jumps. The weights were mended before.
motion::MendedMotion only_reported(motion::MendedMotion mended, const motion::Motion& recorded) {
  mended.jumps.insert(mended.jumps.end(), mended.wild.begin(), mended.wild.end());
  std::erase_if(mended.jumps,
                [](const motion::WildSample& jump) { return jump.off_m <= motion::kWildJump_m; });
  std::ranges::stable_sort(mended.jumps, {}, &motion::WildSample::sample);
  for (auto* readings : {&mended.wild, &mended.zeros, &mended.lone, &mended.ends})
    readings->clear();
  mended.held.clear();
  mended.motion = recorded;
  return mended;
}

}  // namespace

CleanedRecording cleaned_recording(const motion::Motion& recorded, Readings readings) {
  motion::MendedMotion mended = motion::without_wild_samples(recorded);
  if (readings == Readings::of_weights) mended = only_reported(std::move(mended), recorded);
  CleanedRecording out{{}, reading_warnings(mended)};
  out.motion = std::move(mended.motion);
  motion::check_reach_beside_head(out.motion);
  return out;
}

std::optional<Note> check_steady(const motion::Motion& steady, Readings readings) {
  motion::check_reach(steady);
  return far_points_warning(steady, readings);
}

}  // namespace hyperex::session
