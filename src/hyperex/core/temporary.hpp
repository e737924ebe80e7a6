// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Temporary names beside the outputs, ".NAME.PID.tmp", and what to do with those that a killed
// process left behind.
#include <filesystem>
#include <string>

namespace hyperex {

/// A name beside `target` that is this process's own: ".NAME.PID.EXTENSION". Where that is longer
/// than the file system allows, NAME is cut and ends in a hash of the whole name.
std::filesystem::path temporary_beside(const std::filesystem::path& target,
                                       const std::string& extension = "tmp");

/// Such a name for the outputs of a folder, in the folder itself.
std::filesystem::path temporary_within(const std::filesystem::path& folder,
                                       const std::string& extension = "tmp");

/// Whether `name` is one that temporary_beside() or temporary_within() gives for `target`, in any
/// process, with or without the ".going" of an interruption.
bool is_temporary_of(const std::filesystem::path& target, const std::string& name);

/// Marks a file or folder that exists as in use while this lives, by a lock that ends with the
/// process, however that ends. Does nothing where the file system has no locks.
class InUse {
 public:
  explicit InUse(const std::filesystem::path& path);
  ~InUse();
  InUse(InUse&& other) noexcept;
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;
  bool held() const { return held_; }
  /// Another process uses it.
  bool taken() const { return taken_; }
  /// Whether `path` still leads to what was marked, and not to something put in its place.
  bool is_at(const std::filesystem::path& path) const;

 private:
  int file_ = -1;
  bool held_ = false, taken_ = false;
};

/// Removes the temporary files and folders of `target` in `folder` that killed processes left and
/// no living process uses. An earlier output that one of them had moved aside gets its name back if
/// that is free. Reports each in one line; what cannot be removed is left without a message.
void remove_leftovers(const std::filesystem::path& target, const std::filesystem::path& folder);

}  // namespace hyperex
