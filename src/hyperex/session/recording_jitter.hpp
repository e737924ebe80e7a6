// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// The jitter that recorded points show, and how it was found.
struct RecordedJitter {
  double jitter_m = 0;  ///< standard deviation of a coordinate; 0: none, or not known
  /// False if the recording is too short, or shows no jitter: it may be exact, or smoothed.
  bool known = true;
  std::string how;  ///< a clause for a note or a line of output
  bool too_short = false;
};

/// From the fourth differences in time (motion::jitter_of_motion) of the points that S(t) uses, or
/// of all points where it can use none; below 0.01 mm none shows. Too short with fewer than 20
/// samples. `m`: without head pose, with recorded times and lengths.
RecordedJitter recorded_jitter(const motion::Motion& m);

/// Sets Inputs::jitter_m and jitter_known, with a note on their source: output.jitter_mm of the
/// scene, else recorded_jitter(). For a camera's recording that is read in full and too short for
/// that, it is the jitter in the quietest half second (metrics::jitter_at_rest). Points that the
/// program itself moves, the embedded motion or a face model by weights, are exact where none
/// shows.
void settle_jitter(const scene::Scene& scene, Extent extent, const motion::Motion& m, Inputs& in);

}  // namespace hyperex::session
