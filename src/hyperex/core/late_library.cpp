// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/late_library.hpp"

#include <dlfcn.h>

#include "hyperex/core/error.hpp"

namespace hyperex {
namespace fs = std::filesystem;

fs::path late_library_file(const std::string& name) {
  const fs::path below = fs::path("hyperex") / name;
  std::error_code error;
  Dl_info here{};
  if (::dladdr(reinterpret_cast<void*>(&late_library_file), &here) != 0 &&
      here.dli_fname != nullptr) {
    const fs::path folder = fs::path(here.dli_fname).parent_path();
    // A relative path is that of a program as it was called; it must not be used for loading.
    for (const fs::path& lib : {folder, folder.parent_path()})
      if (folder.is_absolute() && fs::exists(lib / below, error)) return lib / below;
  }
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "lib" / below;
}

void* load_late_library(const std::string& name, const char* symbol, const std::string& remedy) {
  const fs::path file = late_library_file(name);
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw InputError(file, std::string("cannot be loaded: ") + ::dlerror() + "; " + remedy);
  void* found = ::dlsym(library, symbol);
  if (found == nullptr)
    throw InputError(file, "is not the part of this program that was looked for; " + remedy);
  return found;
}

}  // namespace hyperex
