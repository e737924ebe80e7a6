// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// The jitter that recorded points show, and how it was found.
struct RecordedJitter {
  double jitter_m = 0;  ///< standard deviation of a coordinate; 0: none, or not known
  bool known = true;
  std::string how;  ///< a clause for a note or a line of output
};

/// From the fourth differences in time (motion::jitter_of_motion) of the points that S(t) takes, or
/// of all points where it can take none; below 0.01 mm none. Not known of fewer than 20 samples.
/// `m`: head pose out, in its own times and lengths.
RecordedJitter recorded_jitter(const motion::Motion& m);

/// Sets Inputs::jitter_m, with a note that says where it comes from: what the scene states
/// (output.jitter_mm), else recorded_jitter; of a camera's recording, read in full, that is too
/// short for it, the jitter in its quietest half second (metrics::jitter_at_rest).
void settle_jitter(const scene::Scene& scene, Extent extent, const motion::Motion& m, Inputs& in);

}  // namespace hyperex::session
