// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A case is known by what it computes from: a run is done again when something of that has changed,
// and only then.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::study {

/// Hashes of files and folders by their content, each read once.
class ContentHashes {
 public:
  /// SHA-256 of a file's bytes, or of the names and bytes of all files in a folder and below; what
  /// is neither ("embedded") as it is.
  std::string of(const std::filesystem::path& path);
  /// Hash of the files that a scan names in turn: materials, textures, buffers.
  std::string of_companions(const std::filesystem::path& scan);

 private:
  std::map<std::filesystem::path, std::string> known_, companions_;
};

/// SHA-256 of the version of the program, every option of the scene and of its variants, and the
/// content of each file they name. Where the files lie makes no difference.
std::string hash_of(const scene::Scene& scene, ContentHashes& contents);

}  // namespace hyperex::study
