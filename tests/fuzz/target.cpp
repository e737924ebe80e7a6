// SPDX-License-Identifier: GPL-3.0-or-later
// One target of libFuzzer: the reader HYPEREX_FUZZ_READER, set by CMake.
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>

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
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  static const hyperex::fuzz::Reader& reader = hyperex::fuzz::reader(HYPEREX_FUZZ_READER);
  spdlog::set_level(spdlog::level::off);
  hyperex::fuzz::try_input(reader, folder.path,
                           std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
