// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/capture/options.hpp"
#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// A recording in the layout of the TUM RGB-D benchmark (Sturm et al., IROS 2012):
///   rgb.txt, depth.txt     "TIME FILE" per line; pictures in rgb/ and depth/
///                          (depth in 16 bit, registered to colour)
///   associations.txt       "TIME COLOUR TIME DEPTH"; where absent, pairs by nearest time (20 ms)
///   camera.toml            camera_file.hpp; the TUM sets have none: SourceOptions::camera_file
/// Without depth.txt and associations.txt, or with colour_only, only the colour pictures of rgb.txt
/// are used. A frame is invalid if a picture is damaged, missing or of the wrong size, if it has no
/// pair, if its time is out of order, or if its depth has no reading. Throws InputError if the
/// lists or the camera cannot be read.
std::unique_ptr<FrameSource> open_tum_folder(const std::filesystem::path& folder,
                                             const SourceOptions& options = {});

}  // namespace hyperex::capture
