// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/capture/intrinsics.hpp"
#include "hyperex/expression/face_model.hpp"
#include "hyperex/tracking/tracked.hpp"

namespace hyperex::report {

/// Writes the tracked face as binary glTF 2.0, metres. The scene (+x right, +y up, the recording's
/// camera at its origin, looking along -z) holds
///   recording_camera   a camera with the recording's field of view, to look through
///   camera_frame       the camera's own frame: x right, y down, z forward
///     head             camera_from_head, animated; its mesh is the person's face at rest (+x the
///                      subject's left, +y up, +z forward) with poses of its motion as morph
///                      targets (pose_keys.hpp, to `tolerance_m`, or as many as fit into 20 MB),
///                      their weights animated
/// Times are counted from the recording's first frame. There is one key per valid frame. During
/// invalid frames the head's scale is 0, so that nothing is visible. Valid frames whose time does
/// not increase are left out. Throws InputError where the file cannot be written,
/// std::invalid_argument where the tracking has no neutral face or it is another model's.
void write_tracked_glb(const std::filesystem::path& file, const expression::FaceModel& model,
                       const tracking::Tracking& tracking, const capture::Intrinsics& camera,
                       double tolerance_m = 3e-4);

}  // namespace hyperex::report
