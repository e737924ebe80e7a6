// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/kept_results.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "hyperex/core/sha256.hpp"
#include "hyperex/core/temporary.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

constexpr const char* kExtension = ".kept";
constexpr std::size_t kDigits = 64;

/// Includes the key, so that no entry can be taken for another.
std::string checksum(const std::string& key, const std::string& bytes) {
  Sha256 hash;
  hash.add_text(key);
  hash.add(bytes.data(), bytes.size());
  return hash.hex();
}

struct Descriptor {
  explicit Descriptor(int opened) : file(opened) {}
  ~Descriptor() {
    if (file >= 0) ::close(file);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  const int file;
};

bool is_own(const struct stat& status) {
  return status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// The user's own folder, which no other user can put anything into.
bool is_private(const fs::path& folder) {
  struct stat status {};
  return ::stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && is_own(status);
}

bool make_private(const fs::path& folder) {
  fs::path way;
  for (const fs::path& part : folder) {
    way /= part;
    if (::mkdir(way.c_str(), S_IRWXU) != 0 && errno != EEXIST && errno != EISDIR &&
        !fs::is_directory(way))
      return false;
  }
  // One of the user's that others may enter, as earlier versions made it, is closed to them.
  struct stat status {};
  return ::stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         status.st_uid == ::geteuid() &&
         ((status.st_mode & (S_IRWXG | S_IRWXO)) == 0 || ::chmod(folder.c_str(), S_IRWXU) == 0);
}

bool read_all(int file, std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t got = ::read(file, bytes.data() + at, bytes.size() - at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += std::size_t(got);
  }
  return true;
}

bool write_all(int file, const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t put = ::write(file, bytes.data() + at, bytes.size() - at);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += std::size_t(put);
  }
  return true;
}

fs::path absolute_from(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path path = value ? value : "";
  return path.is_absolute() ? path : fs::path();
}

}  // namespace

std::optional<std::string> KeptResults::find(const std::string& key) const {
  if (!in_use() || !is_private(folder_)) return std::nullopt;
  const fs::path file = folder_ / (key + kExtension);
  // Not through a link, and without waiting for a pipe.
  const Descriptor entry(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (entry.file < 0 || ::fstat(entry.file, &status) != 0) return std::nullopt;
  if (!S_ISREG(status.st_mode) || !is_own(status)) return std::nullopt;
  const auto size = std::uintmax_t(status.st_size);
  if (size < kDigits || size > most_bytes_) return std::nullopt;
  std::string all(std::size_t(size), '\0');
  if (!read_all(entry.file, all)) return std::nullopt;
  std::string bytes = all.substr(kDigits);
  if (checksum(key, bytes) != all.substr(0, kDigits)) return std::nullopt;
  ::futimens(entry.file, nullptr);  // in use: not the oldest
  return bytes;
}

void KeptResults::keep(const std::string& key, const std::string& bytes) const {
  if (!in_use() || bytes.size() + kDigits > most_bytes_ || !make_private(folder_)) return;
  std::error_code error;
  const fs::path file = folder_ / (key + kExtension), whole = temporary_beside(file);
  {
    const Descriptor entry(
        ::open(whole.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (entry.file < 0) return;
    if (!write_all(entry.file, checksum(key, bytes)) || !write_all(entry.file, bytes)) {
      fs::remove(whole, error);
      return;
    }
  }
  fs::rename(whole, file, error);
  if (error) fs::remove(whole, error);
  remove_oldest();
}

void KeptResults::remove_oldest() const {
  struct Entry {
    fs::file_time_type time;
    std::uintmax_t bytes;
    fs::path file;
  };
  std::vector<Entry> entries;
  std::uintmax_t all = 0;
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() != kExtension) continue;
    std::error_code gone;  // by another process
    const auto time = at->last_write_time(gone);
    const auto bytes = gone ? 0 : at->file_size(gone);
    if (gone) continue;
    entries.push_back({time, bytes, at->path()});
    all += bytes;
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.time < b.time; });
  for (const Entry& entry : entries) {
    if (all <= most_bytes_) return;
    fs::remove(entry.file, error);
    all -= entry.bytes;
  }
}

std::filesystem::path user_cache_folder() {
  if (const fs::path cache = absolute_from("XDG_CACHE_HOME"); !cache.empty())
    return cache / "hyperex";
  const fs::path home = absolute_from("HOME");
  return home.empty() ? home : home / ".cache" / "hyperex";
}

std::string program_identity() {
  const fs::path program = "/proc/self/exe";
  std::error_code error;
  const auto bytes = fs::file_size(program, error);
  const auto time = fs::last_write_time(program, error).time_since_epoch().count();
  return fmt::format("{} {}", bytes, time);
}

}  // namespace hyperex
