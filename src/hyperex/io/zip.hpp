// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>

namespace hyperex::io {

struct UnzipLimits {
  std::uint64_t most_bytes = std::uint64_t(4) << 30U;  ///< unpacked, all files together
  int most_files = 50000;
};

/// Unpacks a zip into `folder`, which must not exist: it appears whole or not at all. Hidden files,
/// such as those that macOS adds, are left out. Nothing is written outside the folder: names with
/// "..", from a root or a drive, with backslashes or control characters, links, and names that
/// occur twice are refused. The unpacked bytes are counted as they come, whatever the headers say,
/// and checked by length and CRC. Read by libarchive; every file and folder is made here, as a new
/// one. Throws InputError naming file and entry: no zip, damaged or truncated, encrypted, packed in
/// an unknown way, over a limit.
void unzip(const std::filesystem::path& zip, const std::filesystem::path& folder,
           const UnzipLimits& limits = {});

}  // namespace hyperex::io
