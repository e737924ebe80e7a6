// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/case_hash.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hyperex/core/error.hpp"
#include "hyperex/core/named_file.hpp"
#include "hyperex/core/sha256.hpp"
#include "hyperex/core/version.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/scene/file_names.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {
using nlohmann::json;

std::string sha256_of(const std::string& text) {
  Sha256 hash;
  hash.add(text.data(), text.size());
  return hash.hex();
}

std::string sha256_of_file(const fs::path& file) {
  Sha256 hash;
  if (!hash.add_file(file)) throw InputError(file, "cannot be read");
  return hash.hex();
}

std::string hash_of_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  const auto options = fs::directory_options::follow_directory_symlink;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options))
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder));
  std::sort(files.begin(), files.end());
  std::string text;
  for (const fs::path& file : files)
    text += sha256_of(file.generic_string()) + sha256_of_file(folder / file);
  return sha256_of(text);
}

/// The files that `scan` refers to, found by reading it; those found so far if it cannot be read.
std::vector<fs::path> companions_of(const fs::path& scan) {
  const NamedFiles named;
  try {
    io::read_scan(scan);
  } catch (const InputError&) {
    // Ignored here: the check of the case reports what is wrong with the file.
  }
  std::vector<fs::path> files = named.requested();
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

json described(const scene::Scene& scene, ContentHashes& contents) {
  const auto by_content = [&](const std::string& path) { return contents.of(path); };
  json text = {{"options", scene::options_with_paths(scene, by_content)}};
  if (!scene.scan.source.embedded)
    text["beside the scan"] = contents.of_companions(scene.scan.source.file);
  return text;
}

}  // namespace

std::string ContentHashes::of(const fs::path& path) {
  const auto known = known_.find(path);
  if (known != known_.end()) return known->second;
  std::error_code error;
  std::string hash = path.string();
  if (fs::is_directory(path, error))
    hash = hash_of_folder(path);
  else if (fs::is_regular_file(path, error))
    hash = sha256_of_file(path);
  return known_[path] = hash;
}

std::string ContentHashes::of_companions(const fs::path& scan) {
  const auto known = companions_.find(scan);
  if (known != companions_.end()) return known->second;
  std::string text;
  for (const fs::path& file : companions_of(scan)) {
    std::error_code error;
    text += file.filename().string() + ' ' +
            (fs::is_regular_file(file, error) ? of(file) : "missing") + '\n';
  }
  return companions_[scan] = sha256_of(text);
}

std::string hash_of(const scene::Scene& scene, ContentHashes& contents) {
  json text = described(scene, contents);
  text["hyperex"] = version();
  for (const scene::Variant& variant : scene.variants) {
    json one = described(variant.scene, contents);
    one["name"] = variant.name;
    text["variants"].push_back(one);
  }
  return sha256_of(text.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace hyperex::study
