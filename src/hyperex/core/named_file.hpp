// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files that another file names, such as a scan's texture or a recording's pictures. The naming
// file may come from somebody else, so it gets no file outside its own folder, and no device.
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex {

/// `folder` / `name`, where that is a regular file in `folder` or below, links followed. Else
/// InputError: missing, outside, a folder, pipe or device.
std::filesystem::path named_file(const std::filesystem::path& folder, const std::string& name);

/// Records the paths that this thread passes to named_file() while the object lives, whether or not
/// they exist. One object at a time.
class NamedFiles {
 public:
  NamedFiles();
  ~NamedFiles();
  NamedFiles(const NamedFiles&) = delete;
  NamedFiles& operator=(const NamedFiles&) = delete;
  const std::vector<std::filesystem::path>& requested() const { return requested_; }

 private:
  friend std::filesystem::path named_file(const std::filesystem::path&, const std::string&);
  std::vector<std::filesystem::path> requested_;
};

/// Like read_file, but refuses a pipe too, before it is opened: reading one might wait for ever.
std::string read_regular_file(const std::filesystem::path& path);

}  // namespace hyperex
