// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/motion/rest.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// The face model that motion.rig or motion.candide names, stored in `own`; else the canonical one.
const expression::FaceModel& face_model(const scene::Scene& scene,
                                        std::optional<expression::FaceModel>& own);

/// The interval of motion.rest_s; a single time means the sample there.
std::optional<motion::RestStretch> rest_stretch(const scene::MotionOptions& options);

/// By the number of frames and the median distance of the first ones, without time.start_s and
/// motion.time_scale; 0 where that is not known. Throws InputError where it cannot be opened.
double expected_length_s(const scene::MotionOptions& options);

/// The points of motion.recording, tracked, or taken from an earlier run; in a quick reading those
/// of its first face alone. Notes go into `in`. Throws InputError where no face is found
/// and where the recording is a single picture.
motion::Motion track_recording(const scene::Scene& scene, Extent extent, Inputs& in);

}  // namespace hyperex::session
