// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace hyperex::metrics {

/// Speeds and paths that jitter alone gives a point at rest.
struct SpeedFloor {
  double peak_mm_s = 0;  ///< largest speed: 95 % of such tracks stay under it
  double path_mm = 0;    ///< length of the way, likewise
  double rms_mm_s = 0;   ///< root mean square speed
};

/// From 200 tracks of white noise with a standard deviation of `jitter_m` (>= 0) a coordinate,
/// sampled at `time_s` and smoothed by lowpassed(time_s, ., cutoff_hz). The seed is fixed: the same
/// input gives the same floors. All 0 where jitter_m is 0 or there are fewer than three samples.
SpeedFloor speed_floor(const std::vector<double>& time_s, double jitter_m, double cutoff_hz);

}  // namespace hyperex::metrics
