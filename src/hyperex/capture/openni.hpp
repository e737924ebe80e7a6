// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Structured-light and other depth cameras through OpenNI2, and its .oni recordings. Colour and
/// depth are paired if they are at most 20 ms apart. Time is 0 at the first frame. If the driver or
/// the recording mirrors the pictures (PrimeSense's driver does by default), they are flipped back,
/// so that left and right are as the camera sees them. The intrinsics come from
/// SourceOptions::camera_file, else from the field of view that the driver states, else from
/// SourceOptions::field_of_view_deg with a note. Depth with another size but the same aspect ratio
/// is resized to the colour picture.

/// `uri` "" opens the first device found. The source is live: wrap it in LatestFrame, as
/// open_source() does. It delivers 640 x 480 at 30 Hz if the device offers this mode, with depth
/// registered to colour by the driver. Throws InputError if there is no device, if it cannot
/// register depth (unless colour_only is set), or if it gives no frame within 5 s.
std::unique_ptr<FrameSource> open_openni(const std::string& uri = "",
                                         const SourceOptions& options = {});

/// Gives the frames in the order of the file; none is dropped. The file does not say whether its
/// depth was registered to colour. It is assumed to be, and a note says so. Throws InputError if
/// the file is not such a recording or contains no colour. Without depth, the source has colour
/// only and a note says so.
std::unique_ptr<FrameSource> open_oni(const std::filesystem::path& file,
                                      const SourceOptions& options = {});

}  // namespace hyperex::capture
