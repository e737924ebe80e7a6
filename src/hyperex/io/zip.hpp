// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace hyperex::io {

struct UnzipLimits {
  std::uint64_t most_bytes = std::uint64_t(4) << 30U;  ///< total size after unpacking
  int most_files = 50000;
};

/// The files of a zip archive, as unzip() would name them below its folder, by the archive's own
/// directory: nothing is unpacked, so that a bomb costs nothing. Throws as unzip() where names,
/// kinds or stated sizes are refused.
std::vector<std::filesystem::path> files_in_zip(const std::filesystem::path& zip,
                                                const UnzipLimits& limits = {});

/// Unpacks a zip archive into `folder`, which must not exist. The folder appears completely or not
/// at all. Hidden files, such as those that macOS adds, are skipped. Nothing is written outside the
/// folder: the archive is refused if a name contains "..", backslashes, control characters or any
/// of :*?"<>|, if it starts at a root, if it occurs twice, or if an entry is a link. The archive's
/// directory is looked at first. The unpacked bytes are counted during unpacking too, independently
/// of the headers, and checked by length and CRC.
/// libarchive reads the archive; every file and folder is newly created by this function. Throws
/// InputError naming file and entry if it is not a zip archive, damaged, truncated, encrypted,
/// packed by an unknown method, or over a limit.
void unzip(const std::filesystem::path& zip, const std::filesystem::path& folder,
           const UnzipLimits& limits = {});

}  // namespace hyperex::io
