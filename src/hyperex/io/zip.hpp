// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>

namespace hyperex::io {

struct UnzipLimits {
  std::uint64_t most_bytes = std::uint64_t(4) << 30U;  ///< total size after unpacking
  int most_files = 50000;
};

/// Unpacks a zip archive into `folder`, which must not exist. The folder appears completely or not
/// at all. Hidden files, such as those that macOS adds, are skipped. Nothing is written outside the
/// folder: the archive is refused if a name contains "..", backslashes, control characters or any
/// of :*?"<>|, if it starts at a root, if it occurs twice, or if an entry is a link. The unpacked
/// bytes are counted during unpacking, independently of the headers, and checked by length and CRC.
/// libarchive reads the archive; every file and folder is newly created by this function. Throws
/// InputError naming file and entry if it is not a zip archive, damaged, truncated, encrypted,
/// packed by an unknown method, or over a limit.
void unzip(const std::filesystem::path& zip, const std::filesystem::path& folder,
           const UnzipLimits& limits = {});

}  // namespace hyperex::io
