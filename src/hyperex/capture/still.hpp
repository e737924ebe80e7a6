// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Whether the file name ends in .jpg, .jpeg or .png.
bool is_picture(const std::filesystem::path& file);

/// A photograph (JPEG or PNG) as a source of one frame at time 0, with colour only. An orientation
/// stored in the file is not applied. As with a video (video.hpp), lengths in metres are unknown
/// and the camera is usually guessed. Throws InputError if the file is missing or damaged, or if
/// its size differs from that in the camera file.
std::unique_ptr<FrameSource> open_still(const std::filesystem::path& file,
                                        const SourceOptions& options = {});

}  // namespace hyperex::capture
