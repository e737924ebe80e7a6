// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <filesystem>

// Videos and webcams are an optional part of the program: OpenCV's videoio may be missing.
namespace hyperex {

inline bool video_is_built() {
  const std::filesystem::path program = HYPEREX_PROGRAM;
  return std::filesystem::exists(program.parent_path().parent_path() / "lib/hyperex/hx_video.so");
}

}  // namespace hyperex

#define SKIP_WITHOUT_VIDEO() \
  if (!hyperex::video_is_built()) GTEST_SKIP() << "built without videos: no libopencv-videoio-dev"
