// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// hyperex studio: a server, and one thread that answers its requests.
#include <filesystem>
#include <string>

#include "hyperex/core/kept_results.hpp"

namespace hyperex::studio {

struct StudioOptions {
  std::filesystem::path started;    ///< a scene or a scan; empty: the embedded face
  std::filesystem::path save_into;  ///< where saved files go
  unsigned short port = 0;          ///< 0: any free one
  bool open_browser = true;
  std::string device;     ///< a camera (capture::open_device); empty: none
  bool mirrored = false;  ///< its pictures are mirrored
  std::string version;
  KeptResults kept;
  bool bands = true;  ///< error bands are computed while nothing else is to do
};

/// Makes StudioOptions::save_into, and its parents, where it is missing. Throws InputError where it
/// is a file or cannot be made.
void make_folder_for_saved_files(const std::filesystem::path& folder);

/// Serves until it is interrupted. Prints the address on standard output. Throws InputError where
/// it cannot start.
void run_studio(const StudioOptions& options);

}  // namespace hyperex::studio
