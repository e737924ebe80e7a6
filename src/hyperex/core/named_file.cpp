// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/named_file.hpp"

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"

namespace hyperex {
namespace fs = std::filesystem;

namespace {
thread_local NamedFiles* listening = nullptr;

void check_regular(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path, "no such file");
  if (fs::is_directory(status)) throw InputError(path, "is a folder; expected a file");
  if (!fs::is_regular_file(status))
    throw InputError(path, "is a pipe or device; expected a regular file");
}
}  // namespace

NamedFiles::NamedFiles() {
  listening = this;
}
NamedFiles::~NamedFiles() {
  listening = nullptr;
}

fs::path named_file(const fs::path& folder, const std::string& name) {
  const fs::path path = folder / name;
  if (listening) listening->requested_.push_back(path);
  check_regular(path);
  std::error_code error;
  const fs::path inside = fs::canonical(folder.empty() ? "." : folder, error);
  const fs::path found = error ? fs::path() : fs::canonical(path, error);
  const auto [end, ignored] =
      std::mismatch(inside.begin(), inside.end(), found.begin(), found.end());
  if (error || end != inside.end())
    throw InputError(path,
                     "lies outside of the folder of the file that names it; expected a file "
                     "in that folder or below");
  return path;
}

std::string read_regular_file(const fs::path& path) {
  check_regular(path);
  return read_file(path);
}

}  // namespace hyperex
