// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// Writes a recording in the layout that open_tum_folder() reads: rgb/TIME.jpg (quality 95),
/// depth/TIME.png (16 bit), rgb.txt, depth.txt, associations.txt and camera.toml. The same frames
/// always give the same bytes.
class TumWriter {
 public:
  /// Makes `folder` and its parents. `depth_per_metre`: stored value per metre, > 0.
  TumWriter(std::filesystem::path folder, const Intrinsics& camera, double depth_per_metre = 5000);

  /// Adds a valid frame whose colour and depth have the camera's size (std::invalid_argument
  /// otherwise). Throws InputError if its pictures cannot be written.
  void add(const Frame& frame);
  /// Writes the lists. Throws InputError where they cannot be written.
  void finish();

 private:
  std::filesystem::path folder_;
  Intrinsics camera_;
  double depth_per_metre_;
  std::string pairs_, colours_, depths_;  // the lists so far
};

}  // namespace hyperex::capture
