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

/// If this function is part of a shared library, hx_video.so is looked for in that library's folder
/// and in the folder above. If it is part of the program itself, hx_video.so is in the program's
/// ../lib.
fs::path video_file() {
  const fs::path name = "hyperex/hx_video.so";
  std::error_code error;
  Dl_info here{};
  if (::dladdr(reinterpret_cast<void*>(&video_file), &here) != 0 && here.dli_fname != nullptr) {
    const fs::path folder = fs::path(here.dli_fname).parent_path();
    // A relative path is that of a program as it was called; it must not be used for loading.
    for (const fs::path& lib : {folder, folder.parent_path()})
      if (folder.is_absolute() && fs::exists(lib / name, error)) return lib / name;
  }
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "lib" / name;
}

const VideoLibrary* load() {
  const fs::path file = video_file();
  if (std::error_code error; !fs::exists(file, error))
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
