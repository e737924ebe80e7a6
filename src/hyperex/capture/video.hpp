// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Videos and webcams give colour only. Without depth, the size and the distance of the face are
/// unknown. Lengths in metres require a length stated by the user, such as the distance between the
/// outer corners of the eyes. The camera comes from SourceOptions::camera_file; without it, it is
/// guessed from SourceOptions::field_of_view_deg and a note says so.

/// Opens any video file that FFmpeg can read. Times are those of the file if they increase;
/// otherwise they follow from its frame rate. frame_count() is the number that the container
/// states. If the file ends earlier, the frames before the end are used and a note says so. Throws
/// InputError if no frame can be read.
std::unique_ptr<FrameSource> open_video(const std::filesystem::path& file,
                                        const SourceOptions& options = {});

/// Opens the webcam with that number (/dev/videoN). The source is live: wrap it in LatestFrame, as
/// open_source() does. If a camera file is given, its picture size is requested. Time is 0 at the
/// first frame. Whether the camera mirrors its picture is unknown; the user must state it.
std::unique_ptr<FrameSource> open_webcam(int number, const SourceOptions& options = {});

}  // namespace hyperex::capture
