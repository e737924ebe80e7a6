// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "hyperex/core/error.hpp"

namespace hyperex {
namespace fs = std::filesystem;

namespace {
fs::path temporary_beside(const fs::path& target, const char* extension = "tmp") {
  return target.parent_path() / fmt::format(".{}.{}.{}", target.filename().string(),
                                            static_cast<long>(::getpid()), extension);
}

fs::path without_slash(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}
}  // namespace

void check_folder_of(const fs::path& path) {
  const fs::path folder = path.parent_path();
  std::error_code error;
  if (!folder.empty() && !fs::is_directory(folder, error))
    throw InputError(path, "cannot be written: there is no folder " + folder.string());
}

void write_file_atomically(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  const TemporaryPath listed(temporary_beside(path));
  const fs::path& temporary = listed.path();
  std::error_code ignored;
  const auto fail = [&](const std::string& why) {
    fs::remove(temporary, ignored);
    throw InputError(path, "cannot be written (" + why + ")");
  };
  {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream) fail(std::strerror(errno));
    try {
      write(stream);
    } catch (...) {
      stream.close();
      fs::remove(temporary, ignored);
      throw;
    }
    stream.flush();
    if (!stream) fail(errno ? std::strerror(errno) : "the disk may be full");
  }
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) fail(error.message());
}

OutputDirectory::OutputDirectory(fs::path target, std::string marker)
    : target_(without_slash(fs::absolute(target).lexically_normal())),
      temporary_(temporary_beside(target_)),
      marker_(std::move(marker)) {
  std::error_code error;
  if (fs::exists(target_)) {
    if (!fs::is_directory(target_))
      throw InputError(target_, "is a file; expected the name of a folder for the outputs");
    if (!fs::is_empty(target_) && !fs::exists(target_ / marker_))
      throw InputError(target_, fmt::format("holds other files and no earlier run's {}; expected a "
                                            "new or empty folder, or one of an earlier run",
                                            marker_));
  }
  fs::create_directories(target_.parent_path(), error);
  fs::remove_all(path(), error);
  error.clear();
  fs::create_directory(path(), error);
  if (error) throw InputError(target_, "cannot be created (" + error.message() + ")");
}

OutputDirectory::~OutputDirectory() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(path(), ignored);
}

std::string OutputDirectory::with_own_name(std::string text) const {
  const std::string from = path().string(), to = target_.string();
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

void OutputDirectory::commit() {
  // An earlier run's folder is moved aside, not removed, until this one stands in its place.
  const auto together = hold_off_interruption();
  const fs::path aside = temporary_beside(target_, "old");
  std::error_code error, ignored;
  const auto fail = [&] {
    throw InputError(target_, "cannot be written (" + error.message() + ")");
  };
  const bool replaces = fs::exists(target_, ignored);
  if (replaces) {
    fs::remove_all(aside, ignored);
    fs::rename(target_, aside, error);
    if (error) fail();
  }
  fs::rename(path(), target_, error);
  if (error) {
    if (replaces) fs::rename(aside, target_, ignored);
    fail();
  }
  committed_ = true;
  if (replaces) fs::remove_all(aside, ignored);
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(path, "no such file");
  if (fs::is_directory(path, error)) throw InputError(path, "is a folder; expected a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path, "cannot be read");
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

}  // namespace hyperex
