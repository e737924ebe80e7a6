// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// A recording in the layout of the TUM RGB-D benchmark (Sturm et al., IROS 2012):
///   rgb.txt, depth.txt     "TIME FILE" a line, pictures in rgb/ and depth/ (16 bit, depth
///   registered
///                          to colour)
///   associations.txt       "TIME COLOUR TIME DEPTH"; where absent, pairs by nearest time (20 ms)
///   camera.toml            camera_file.hpp; the TUM sets have none: SourceOptions::camera_file
/// Without depth.txt and associations.txt, or with colour_only, the colour of rgb.txt alone.
/// A torn or missing picture, a missing pair, a time out of order, a wrong size and depth without a
/// reading make that frame invalid. Throws InputError where the lists or the camera cannot be read.
std::unique_ptr<FrameSource> open_tum_folder(const std::filesystem::path& folder,
                                             const SourceOptions& options = {});

}  // namespace hyperex::capture
