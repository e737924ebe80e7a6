// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>

namespace hyperex::capture {

struct SourceOptions {
  /// Leave the depth out, as if there were none.
  bool colour_only = false;
  /// A camera.toml (camera_file.hpp) that goes before what the source says or would guess.
  std::filesystem::path camera_file = {};
  /// Where nobody knows the camera: degrees across the longer side of its picture, 10 to 170.
  /// Webcams and phones lie between 50 and 75.
  double field_of_view_deg = 60;
  /// Frames of a recording decoded ahead on a thread, 2 MB each at 640 x 480 with depth; 0 = none,
  /// each is read when it is requested.
  std::size_t read_ahead_frames = 8;
};

}  // namespace hyperex::capture
