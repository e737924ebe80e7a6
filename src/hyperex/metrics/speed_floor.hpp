// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace hyperex::metrics {

/// Speeds and path lengths that jitter alone produces for a point at rest.
struct SpeedFloor {
  double peak_mm_s = 0;  ///< largest speed; 95 % of such tracks stay below it
  double path_mm = 0;    ///< path length; 95 % of such tracks stay below it
  double rms_mm_s = 0;   ///< root mean square speed
};

/// Estimated from 200 tracks (of over 3000 samples: fewer, at least 20) of white noise with
/// standard deviation `jitter_m` (>= 0) per coordinate, sampled at `time_s` and smoothed by
/// lowpassed(time_s, ., cutoff_hz). The random seed is fixed, so that the same input gives the same
/// floors. All are 0 if jitter_m is 0 or if there are fewer than three samples.
SpeedFloor speed_floor(const std::vector<double>& time_s, double jitter_m, double cutoff_hz);

}  // namespace hyperex::metrics
