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

/// Writes the weights of ARKit's blend shapes over time in the format of Live Link Face, for
/// programs that read its recordings. Timecodes HH:MM:SS:FF.fff count 60ths of a second from the
/// first frame; in a recording of less than half a second, readers cannot determine this rate. A
/// blend shape that the model does not have is 0. The angles are also 0, because Epic does not
/// document their signs. The format has no row for a frame without a face: such frames are omitted,
/// and so are frames whose time does not increase. Throws InputError if the file cannot be written
/// or if no frame is valid.
void write_live_link_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                         const Tracking& tracking);

}  // namespace hyperex::tracking
