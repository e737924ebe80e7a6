// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/scene/inputs.hpp"

namespace hyperex::scene {

/// Sets Inputs::jitter_m, with a note that says where it comes from: what the scene states
/// (output.jitter_mm); of a camera's recording, looked at whole, that of the points at rest
/// (metrics::jitter_at_rest); of a file of points or expressions what their fourth differences tell
/// (motion::jitter_of_motion), below 0.01 mm none. `m`: the recording, head pose out, in its own
/// times and lengths.
void settle_jitter(const Scene& scene, Look look, const motion::Motion& m, Inputs& in);

}  // namespace hyperex::scene
