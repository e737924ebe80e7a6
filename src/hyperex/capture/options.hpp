// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>

namespace hyperex::capture {

struct SourceOptions {
  /// Ignore the depth.
  bool colour_only = false;
  /// A camera.toml (camera_file.hpp), which takes precedence over what the source states or would
  /// guess.
  std::filesystem::path camera_file = {};
  /// Used if the intrinsics are unknown: the angle covered by the longer side of the picture,
  /// degrees, 10 to 170. Webcams and phones have between 50 and 75.
  double field_of_view_deg = 60;
  /// Number of frames of a recording that are decoded in advance on another thread. Each takes 2 MB
  /// at 640 x 480 with depth. 0: each frame is read when it is requested.
  std::size_t read_ahead_frames = 8;
};

}  // namespace hyperex::capture
