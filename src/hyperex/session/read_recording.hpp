// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// The parts of read_inputs() that concern the recording. Notes go into `in`.

/// A rig is moved by weights and is the face model then. Throws InputError where motion.rig stands
/// without weights or beside another face model.
void check_rig(const scene::Scene& scene);

/// Reads the motion that the scene's [motion] names, other than the embedded one. Throws
/// InputError.
motion::Motion read_motion(const scene::Scene& scene, Extent extent, Inputs& in);

/// Fills gaps, removes the head pose, and takes rest from motion.rest_s. Where the face
/// is led from rest into the recording, the gaze is, too. Throws InputError.
motion::StabilisedMotion steady_motion(const scene::Scene& scene, const motion::Motion& m,
                                       Extent extent, Inputs& in);

/// Applies motion.point_gain and motion.time_scale, the latter to the gaze as well, and finds the
/// jitter. Throws InputError for gains on points that the recording lacks, and where nothing would
/// move.
void scale_motion(const scene::Scene& scene, Extent extent, motion::Motion& m, Inputs& in);

/// Checks a recording where the scan's landmarks are unknown, and adds notes. Throws InputError
/// where left and right are exchanged.
void check_without_landmarks(const scene::Scene& scene, const motion::Motion& m, Inputs& in);

}  // namespace hyperex::session
