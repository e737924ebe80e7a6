// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {

/// The columns of a CSV by Epic's Live Link Face, in its order: Timecode, BlendShapeCount, ARKit's
/// 52 blend shapes with a capital letter, and nine angles of head and eyes.
const std::vector<std::string>& live_link_columns();

/// Weights of ARKit's blend shapes over time in the format of Live Link Face, for programs that
/// read its recordings. Timecodes HH:MM:SS:FF.fff count 60ths of a second from the first frame; a
/// recording of less than half a second does not determine this rate. A blend shape that the model
/// does not have is 0, and so are the angles, whose signs Epic does not document. The format has no
/// row for a frame without a face: those, and frames whose time does not rise, are left out. Throws
/// InputError where the file cannot be written, or where no frame is valid.
void write_live_link_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                         const Tracking& tracking);

}  // namespace hyperex::tracking
