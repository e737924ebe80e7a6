// SPDX-License-Identifier: GPL-3.0-or-later
// The targets of libFuzzer: run as fuzz_NAME, by a link, it feeds the reader NAME.
#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "fuzz/readers.hpp"

namespace {
/// Inputs go through a file, as a user's do: in memory where there is such a place.
std::filesystem::path make_folder() {
  const std::filesystem::path memory = "/dev/shm";
  const auto folder =
      (std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path()) /
      ("hyperex_fuzz_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

struct Folder {
  std::filesystem::path path = make_folder();
  /// The same folder by a path that is the same in every process: messages quote it, and libFuzzer
  /// takes words for its inputs from what it sees there.
  std::filesystem::path same_path =
      "/proc/self/fd/" + std::to_string(::open(path.c_str(), O_PATH | O_DIRECTORY));
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

const hyperex::fuzz::Reader* fed = nullptr;
}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** arguments) {
  const std::string name = std::filesystem::path((*arguments)[0]).filename();
  fed = &hyperex::fuzz::reader(name.substr(name.find('_') + 1));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  hyperex::fuzz::try_input(*fed, folder.same_path,
                           std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
