// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Output appears whole or not at all: everything is written under a temporary name beside its
// target and renamed when complete.
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

#include "hyperex/core/interrupt.hpp"

namespace hyperex {

/// Writes `path` through `write(stream)`: to a temporary name, checked, then renamed.
/// Throws InputError where the file cannot be written whole (no folder, no right, disk full).
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(std::ostream&)>& write);

/// Throws InputError where `path` could not be written for want of its folder: to be asked before
/// the work that it is to hold.
void check_folder_of(const std::filesystem::path& path);

/// A folder of outputs filled under a temporary name; commit() gives it its own, replacing a
/// folder of that name only when that is empty or an earlier output (holds `marker`).
/// Without commit() the destructor removes everything, and so does an interruption.
class OutputDirectory {
 public:
  OutputDirectory(std::filesystem::path target, std::string marker = "summary.json");
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;
  /// Where to write until commit().
  const std::filesystem::path& path() const { return temporary_.path(); }
  /// `text` with the folder's own name in the place of the temporary one: for messages.
  std::string with_own_name(std::string text) const;
  /// An earlier output stays as it was where this throws InputError.
  void commit();

 private:
  std::filesystem::path target_;
  TemporaryPath temporary_;
  std::string marker_;
  bool committed_ = false;
};

/// The whole file as bytes; InputError where it is missing, a folder or unreadable.
std::string read_file(const std::filesystem::path& path);

}  // namespace hyperex
