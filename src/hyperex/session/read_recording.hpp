// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// The parts of read_inputs() that concern the recording. Notes go into `in`.

/// What the scene's [motion] names, but the embedded motion. Throws InputError.
motion::Motion read_motion(const scene::Scene& scene, Extent extent, Inputs& in);

/// Gaps filled, head pose out, rest where motion.rest_s says. Throws InputError.
motion::StabilisedMotion steady_motion(const scene::Scene& scene, const motion::Motion& m,
                                       Extent extent, Inputs& in);

/// Applies motion.point_gain and motion.time_scale, and finds the jitter. Throws InputError for
/// gains on points that the recording lacks, and where nothing would move.
void scale_motion(const scene::Scene& scene, Extent extent, motion::Motion& m, Inputs& in);

/// What a recording shows where the scan's landmarks are not known. Throws InputError where left
/// and right are exchanged.
void check_without_landmarks(const scene::Scene& scene, const motion::Motion& m, Inputs& in);

}  // namespace hyperex::session
