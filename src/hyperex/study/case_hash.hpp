// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A case is identified by its inputs: it is run again if one of them has changed, and only then.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::study {

/// Hashes of the contents of files and folders. Each is read once.
class ContentHashes {
 public:
  /// SHA-256 of a file's bytes, or of the names and bytes of all files in a folder and its
  /// subfolders. A path that is neither ("embedded") is returned as it is.
  std::string of(const std::filesystem::path& path);
  /// Hash of the files that a scan refers to: materials, textures, buffers.
  std::string of_companions(const std::filesystem::path& scan);

 private:
  std::map<std::filesystem::path, std::string> known_, companions_;
};

/// SHA-256 of the version of the program, every option of the scene and of its variants, and the
/// content of each file they name. Where the files lie makes no difference.
std::string hash_of(const scene::Scene& scene, ContentHashes& contents);

}  // namespace hyperex::study
