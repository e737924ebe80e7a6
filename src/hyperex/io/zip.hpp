// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>

namespace hyperex::io {

struct UnzipLimits {
  std::uint64_t most_bytes = std::uint64_t(4) << 30U;  ///< unpacked, all files together
  int most_files = 50000;
};

/// Unpacks a zip into `folder`, which must not be there: it appears whole or not at all. Stored and
/// deflated files; hidden files, such as those that macOS adds, are left out. Nothing is written
/// outside the folder: names with "..", from a root or a drive, with backslashes or control
/// characters, links, and a name that is there twice are refused. What a file unpacks to is counted
/// while it is unpacked, whatever its header says, and checked by its length and CRC.
/// Throws InputError naming file and entry: no zip, damaged or truncated, encrypted, of another
/// method, in parts, of the 64-bit form, over a limit.
void unzip(const std::filesystem::path& zip, const std::filesystem::path& folder,
           const UnzipLimits& limits = {});

}  // namespace hyperex::io
