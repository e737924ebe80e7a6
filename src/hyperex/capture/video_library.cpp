// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/video_library.hpp"

#include <filesystem>

#include "hyperex/core/error.hpp"
#include "hyperex/core/late_library.hpp"

namespace hyperex::capture {
namespace {
constexpr const char* kRemedy =
    "install libopencv-videoio-dev (scripts/setup.sh --video) and build again (make build)";

const VideoLibrary* load() {
  const std::filesystem::path file = late_library_file("hx_video.so");
  if (std::error_code error; !std::filesystem::exists(file, error))
    throw InputError(
        file,
        std::string("missing: this program was built without videos and webcams; ") + kRemedy);
  using Give = const VideoLibrary*();
  return reinterpret_cast<Give*>(load_late_library("hx_video.so", "hyperex_video", kRemedy))();
}

}  // namespace

const VideoLibrary& video_library() {
  static const VideoLibrary* const library = load();
  return *library;
}

}  // namespace hyperex::capture
