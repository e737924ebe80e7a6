// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Structured-light and other depth cameras through OpenNI2, and its .oni recordings. Colour and
/// depth are paired where they are at most 20 ms apart; time is 0 at the first frame. Pictures that
/// the driver mirrors (PrimeSense's do by default), or that were recorded so, are turned back: left
/// and right are as the camera sees them. Intrinsics: SourceOptions::camera_file, else the field of
/// view that the driver states, else SourceOptions::field_of_view_deg (with a note).
/// Depth of another size but the same shape is brought to the colour picture's size.

/// `uri` "" is the first device found. Live: wrap it in LatestFrame, as open_source() does. 640 x
/// 480 at 30 Hz where the device offers it, depth registered to colour by the driver. Throws
/// InputError where there is none, it cannot register (unless colour_only), or gives no frame
/// within 5 s.
std::unique_ptr<FrameSource> open_openni(const std::string& uri = "",
                                         const SourceOptions& options = {});

/// Frame by frame in the order of the file, none dropped. A file does not say whether its depth
/// was registered to colour: it is taken to be, and a note says so. Throws InputError where it is
/// no such file or holds no colour (or no depth: then with a note, colour only).
std::unique_ptr<FrameSource> open_oni(const std::filesystem::path& file,
                                      const SourceOptions& options = {});

}  // namespace hyperex::capture
