// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files are read whole and appear whole or not at all: everything is written under a temporary name
// beside its target and renamed when complete.
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace hyperex {

/// Writes `path` through `write(stream)`: to a temporary name, checked, then renamed. A link is
/// followed; a device, a pipe or the target of standard output is written to, not replaced; a file
/// that is replaced keeps its permissions. Throws InputError where the file cannot be written whole
/// (no folder, no right, disk full).
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(std::ostream&)>& write);

/// Call it before the work whose results `outputs` will hold; empty paths are ignored. Throws
/// InputError where one of them is a folder, has no folder or no permission to be written, or is
/// also one of `inputs` or another output. Removes temporary files that killed processes left.
void check_outputs(const std::vector<std::filesystem::path>& outputs,
                   const std::vector<std::filesystem::path>& inputs = {});

/// The path that is actually written when `path` is written: links are followed, also to a file
/// that does not exist yet. Throws InputError for a folder and for circular links.
std::filesystem::path followed_links(const std::filesystem::path& path);

/// The whole file as bytes; InputError where it is missing, a folder, a device or unreadable.
std::string read_file(const std::filesystem::path& path);

}  // namespace hyperex
