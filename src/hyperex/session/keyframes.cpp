// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/keyframes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/quantile.hpp"

namespace hyperex::session {
namespace {

constexpr double kOffMultiple = 0.1;  // of the median step
constexpr double kFewOff = 0.2;       // of all steps
constexpr double kSlowestDevice_s = 0.5;
constexpr double kCameraFrame_s = 1.0 / 30;
constexpr std::size_t kMostKeyframes = 30;

/// Whether the steps are whole multiples of the median one, but for a few.
bool are_sampled_evenly(const std::vector<double>& time_s, double step_s) {
  std::size_t off = 0;
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    const double steps = (time_s[k] - time_s[k - 1]) / step_s;
    if (std::abs(steps - std::max(1.0, std::round(steps))) > kOffMultiple) ++off;
  }
  return double(off) <= kFewOff * double(time_s.size() - 1);
}

/// Frame numbers that stand in the place of times.
bool count_frames(const std::vector<double>& time_s) {
  for (std::size_t k = 1; k < time_s.size(); ++k)
    if (time_s[k] - time_s[k - 1] != 1) return false;
  return true;
}

}  // namespace

bool are_keyframes(const std::vector<double>& time_s) {
  if (time_s.size() < 2 || time_s.size() > kMostKeyframes) return false;
  const double step_s = median_step(time_s), lasts_s = time_s.back() - time_s.front();
  if (step_s <= motion::Motion::kSmoothUpTo_s) return false;
  return !are_sampled_evenly(time_s, step_s) ||
         (step_s > kSlowestDevice_s && 1e-3 * lasts_s < kCameraFrame_s && !count_frames(time_s));
}

std::optional<Note> keyframes_note(const motion::Motion& m, Readings readings) {
  if (readings != Readings::of_weights || !are_keyframes(m.time_s)) return std::nullopt;
  return make_note(
      "recording.keyframes",
      fmt::format("the table's {} rows are taken for keyframes, as no device samples at such times "
                  "(a row every {:.2g} s, median): between two of them a point stays within the "
                  "range of both places",
                  m.time_s.size(), median_step(m.time_s)));
}

}  // namespace hyperex::session
