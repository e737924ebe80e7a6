// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A single file that a command writes, and how an earlier output is distinguished from a user's
// file of the same name.
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex {

struct OutputFile {
  std::filesystem::path path;           ///< empty: not requested
  std::vector<std::string> extensions;  ///< as ".csv", lower case; one of them ends the name
  /// How a file of this kind begins, and texts that its first 4 MiB hold too. Both empty: an
  /// output cannot be recognised, and no existing file is replaced.
  std::string begins;
  std::vector<std::string> holds = {};
};

/// The same with the extension of its kind and the mark that render::write_png leaves in its files.
OutputFile png_output(const std::filesystem::path& path);

/// Call it before any work, after check_outputs. Throws InputError for a name that does not end as
/// the command's files do, and for a file that is there already and is not of that kind. Empty
/// files may be replaced; a device or a pipe may have any name.
void check_output_kinds(const std::vector<OutputFile>& outputs);

}  // namespace hyperex
