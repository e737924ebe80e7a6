// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/motion/motion.hpp"
#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {

/// The landmarks of the model over time in the head frame (+x the subject's left, +y up, +z
/// forward); with `with_vertices` also its vertices ("vertex_K"). Rows are NaN if the frame is not
/// valid. Frames whose time does not increase are omitted.
motion::Motion motion_of(const expression::FaceModel& model, const Tracking& tracking,
                         bool with_vertices);

/// Write tables with one row per frame, valid or not. Numbers are "nan" if the frame is not valid.
///  pose:   time_s; valid, 1 or 0; T00 ... T23 (camera_from_head, metres); quality of the fit:
///          network_rms_px, depth_rms_mm ("nan" without depth), depth_share, skin_share,
///          network_score (FitReport, TrackedFrame); faces_in_view; metric, 1 if lengths come from
///          depth, 0 if from the stated distance of the eyes; frame: its number in the source, with
///          gaps for dropped frames; fault: one line, why it is not valid
///  units:  time_s, valid and one column per unit: "NAME [FACS]"
///  arkit:  time_s and ARKit's names, 0 to 1: weights of the model's units converted by its table;
///          a name that several units share is their mean
void write_pose_csv(const std::filesystem::path& file, const Tracking& tracking);
void write_units_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                     const Tracking& tracking);
void write_arkit_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                     const Tracking& tracking);

}  // namespace hyperex::tracking
