// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/kept_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <vector>

#include "hyperex/core/sha256.hpp"
#include "hyperex/core/temporary.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

constexpr const char* kExtension = ".kept";
constexpr std::size_t kDigits = 64;

std::string checksum(const std::string& bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.hex();
}

fs::path absolute_from(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path path = value ? value : "";
  return path.is_absolute() ? path : fs::path();
}

}  // namespace

std::optional<std::string> KeptResults::find(const std::string& key) const {
  if (!in_use()) return std::nullopt;
  const fs::path file = folder_ / (key + kExtension);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size < kDigits || size > most_bytes_) return std::nullopt;
  std::string all(std::size_t(size), '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(all.data(), std::streamsize(all.size()))) return std::nullopt;
  std::string bytes = all.substr(kDigits);
  if (checksum(bytes) != all.substr(0, kDigits)) return std::nullopt;
  fs::last_write_time(file, fs::file_time_type::clock::now(), error);  // in use: not the oldest
  return bytes;
}

void KeptResults::keep(const std::string& key, const std::string& bytes) const {
  if (!in_use() || bytes.size() + kDigits > most_bytes_) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  const fs::path file = folder_ / (key + kExtension), whole = temporary_beside(file);
  {
    std::ofstream stream(whole, std::ios::binary);
    stream << checksum(bytes) << bytes;
    stream.close();
    if (!stream) {
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
