// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/motion/motion.hpp"
#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {

/// The model's landmarks, and on demand its vertices ("vertex_K"), over time in the head's frame
/// (+x the subject's left, +y up, +z forward); rows of NaN where a frame is not valid. Frames whose
/// time does not rise are left out.
motion::Motion motion_of(const expression::FaceModel& model, const Tracking& tracking,
                         bool with_vertices);

/// Tables with a row per frame, whether valid or not; numbers are "nan" where it is not valid.
///  pose:   time_s; valid, 1 or 0; T00 ... T23 (camera_from_head, metres); how well the frame was
///          met: network_rms_px, depth_rms_mm ("nan" without depth), depth_share, skin_share,
///          network_score (FitReport, TrackedFrame); faces_in_view; metric, 1 where lengths come
///          from depth, 0 where from the stated distance of the eyes; frame: its number in the
///          source, where dropped ones leave gaps; fault: one line, why it is not valid
///  units:  time_s, valid and a column per unit: "NAME [FACS]"
///  arkit:  time_s and ARKit's names, 0 to 1: weights of the model's units by its table; a name
///          that several units share is their mean
void write_pose_csv(const std::filesystem::path& file, const Tracking& tracking);
void write_units_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                     const Tracking& tracking);
void write_arkit_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                     const Tracking& tracking);

}  // namespace hyperex::tracking
