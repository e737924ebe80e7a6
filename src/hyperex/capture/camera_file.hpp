// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/capture/frame.hpp"
#include "hyperex/capture/options.hpp"

namespace hyperex::capture {

/// The contents of a camera.toml:
///   width, height          whole pixels > 0
///   fx, fy, cx, cy         pixels; pinhole without distortion, pixel centres at integers
///   depth_scale = 5000     stored depth value per metre, where depth is stored as whole numbers
///   fps                    > 0, not needed
struct Camera {
  Intrinsics intrinsics;
  double depth_per_metre = 5000;
  std::vector<std::string> notes;  ///< names the keys that are not used
};

/// Throws InputError if the file is not TOML, if a key is missing or out of range, or if the file
/// states a lens distortion (k1, k2, ... other than 0), which the pinhole model would ignore.
Camera read_camera_file(const std::filesystem::path& file);

/// The intrinsics of a pinhole camera with square pixels and a centred principal point, whose
/// longer picture side covers the angle `field_of_view_deg`:
///   f = long side / (2 tan(field of view / 2)),  cx = (width - 1) / 2,  cy = (height - 1) / 2.
/// Throws InputError outside 10 to 170 degrees.
Intrinsics guess_intrinsics(int width_px, int height_px, double field_of_view_deg);

/// The camera for pictures of this size: the one in SourceOptions::camera_file, or without such a
/// file a guessed one, which is then reported in `notes`. `source` is used in messages. Throws
/// InputError if the camera file cannot be used or describes pictures of another size.
Intrinsics intrinsics_of(const std::string& source, int width_px, int height_px,
                         const SourceOptions& options, std::vector<std::string>& notes);

/// "640 x 480"
std::string size_text(int width_px, int height_px);

}  // namespace hyperex::capture
