// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/expression/face_model.hpp"
#include "hyperex/tracking/tracked.hpp"

namespace hyperex::report {

/// The contents of the page. References must outlive the call.
struct TrackingPageInput {
  const expression::FaceModel& model;
  const tracking::Tracking& tracking;  ///< of this model, with its neutral face
  std::string recording;               ///< as the user named it; the page shows its last part
  /// Outer eye corner to outer eye corner as stated, which lengths rest on where the neutral face
  /// is not metric.
  double eye_distance_mm = 0;
  std::vector<std::string> notes;  ///< what the source and the tracker say, a sentence each
};

/// Writes one HTML file with the tracking's curves over time (tracking_channels.hpp), to be opened
/// in a browser without any network: the page built from web/ with a JSON manifest (see
/// web/src/tracking/manifest.ts). Numbers are rounded to 0.01 degree, mm or pixel, 0.1 % and 0.001
/// of a unit's weight, or coarser where one would not fit into 16 bits. Throws InputError where the
/// file cannot be written, std::invalid_argument as tracking_curves does.
void write_tracking_page(const std::filesystem::path& file, const TrackingPageInput& input);

}  // namespace hyperex::report
