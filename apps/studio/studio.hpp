// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// hyperex studio: a server, and one thread that answers what comes in through it.
#include <filesystem>
#include <string>

#include "hyperex/core/kept_results.hpp"

namespace hyperex::studio {

struct StudioOptions {
  std::filesystem::path started;    ///< a scene or a scan; empty: the face that the program carries
  std::filesystem::path save_into;  ///< where saved files go
  unsigned short port = 0;          ///< 0: one that is free
  bool open_browser = true;
  std::string device;     ///< a camera (capture::open_device); empty: none
  bool mirrored = false;  ///< its pictures are a mirror's
  std::string version;
  KeptResults kept;
};

/// Serves until it is interrupted. Prints the address on standard output. Throws InputError where
/// it cannot begin.
void run_studio(const StudioOptions& options);

}  // namespace hyperex::studio
