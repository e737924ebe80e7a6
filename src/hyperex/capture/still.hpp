// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Whether the file's name ends as a picture's does: .jpg, .jpeg or .png.
bool is_picture(const std::filesystem::path& file);

/// A photograph (JPEG or PNG) as a source of one frame at time 0, colour alone, as stored: an
/// orientation noted in the file is not applied. Metres are unknown and the camera mostly guessed,
/// as with a video (video.hpp). Throws InputError where it is missing or torn, or not of the camera
/// file's size.
std::unique_ptr<FrameSource> open_still(const std::filesystem::path& file,
                                        const SourceOptions& options = {});

}  // namespace hyperex::capture
