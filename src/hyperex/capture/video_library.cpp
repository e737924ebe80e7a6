// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/video_library.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "hyperex/core/error.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

constexpr const char* kRemedy =
    "install libopencv-videoio-dev (scripts/setup.sh --video) and build again (make build)";

const VideoLibrary* load() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path file = program.parent_path().parent_path() / "lib/hyperex/hx_video.so";
  if (error || !fs::exists(file))
    throw InputError(
        file,
        std::string("missing: this program was built without videos and webcams; ") + kRemedy);
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw InputError(file, std::string("cannot be loaded: ") + ::dlerror() + "; " + kRemedy);
  using Give = const VideoLibrary*();
  auto* give = reinterpret_cast<Give*>(::dlsym(library, "hyperex_video"));
  if (give == nullptr) throw InputError(file, "is not the part of this program that reads videos");
  return give();
}

}  // namespace

const VideoLibrary& video_library() {
  static const VideoLibrary* const library = load();
  return *library;
}

}  // namespace hyperex::capture
