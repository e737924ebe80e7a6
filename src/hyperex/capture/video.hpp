// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Colour alone. Without depth nobody knows how large the face is and how far away: metres have to
/// come from a length that the user states, such as the distance of the outer corners of the eyes.
/// The camera is SourceOptions::camera_file, else guessed from SourceOptions::field_of_view_deg
/// (and a note says so).

/// What FFmpeg opens. Times are the file's own where they rise, else counted by its
/// frame rate. frame_count() is what the container states. A file that ends before that is read as
/// far as it goes and gets a note. Throws InputError where no frame can be read.
std::unique_ptr<FrameSource> open_video(const std::filesystem::path& file,
                                        const SourceOptions& options = {});

/// The webcam of that number (/dev/videoN), live: wrap it in LatestFrame, as open_source() does.
/// Where a camera file is given, its picture size is requested. Time begins at 0 with the first
/// frame. Whether the camera mirrors its picture is not known: the user must say it.
std::unique_ptr<FrameSource> open_webcam(int number, const SourceOptions& options = {});

}  // namespace hyperex::capture
