// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/file_names.hpp"

#include <algorithm>
#include <filesystem>

#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {
namespace {
using nlohmann::json;

/// The last part of a path, with or without a slash at its end.
std::string last_part(const std::string& text) {
  const std::filesystem::path path(text);
  return (path.has_filename() ? path : path.parent_path()).filename().generic_string();
}

/// Calls `visit` with every path in the value of a key.
template <class Visit>
void for_paths(const KeyInfo& key, json& value, Visit visit) {
  if (key.kind == Kind::path && value.is_string() && !value.get_ref<std::string&>().empty())
    visit(value);
  if (key.kind != Kind::rows || !value.is_array()) return;
  for (json& row : value)
    for (const KeyInfo& column : key.columns)
      if (row.is_object() && row.contains(column.name)) for_paths(column, row[column.name], visit);
}

void shorten(const KeyInfo& key, json& value) {
  for_paths(key, value, [](json& path) { path = last_part(path.get<std::string>()); });
}

}  // namespace

json options_with_paths(const Scene& scene,
                        const std::function<std::string(const std::string&)>& named) {
  json options = options_json(scene);
  for (const Key& key : keys()) {
    const std::string section = section_of(key.name);
    if (section.empty()) continue;
    for_paths(key, options[section][key.name.substr(section.size() + 1)],
              [&](json& path) { path = named(path.get<std::string>()); });
  }
  return options;
}

namespace {

void add_paths(const Scene& scene, std::vector<std::string>& paths) {
  for (const Key& key : keys()) {
    json value = key.get(scene);
    for_paths(key, value, [&](const json& path) {
      paths.push_back(path.get<std::string>());
      if (paths.back().ends_with('/')) paths.back().pop_back();
    });
  }
  for (const Variant& variant : scene.variants) add_paths(variant.scene, paths);
}

}  // namespace

json echoed_options(const Scene& scene) {
  return scene.output.full_paths ? options_json(scene) : options_with_paths(scene, last_part);
}

json echoed_changes(const Scene& scene, const json& changes) {
  json echoed = changes;
  if (scene.output.full_paths) return echoed;
  for (auto& [name, value] : echoed.items())
    if (const Key* key = find_key(name)) shorten(*key, value);
  return echoed;
}

std::string with_file_names(const Scene& scene, std::string note) {
  if (scene.output.full_paths) return note;
  std::vector<std::string> paths;
  add_paths(scene, paths);
  // Longer paths first, since the path of one input may be the beginning of another's.
  std::sort(paths.begin(), paths.end(),
            [](const auto& a, const auto& b) { return a.size() > b.size(); });
  for (const std::string& path : paths) {
    const std::string name = last_part(path);
    if (name.size() == path.size()) continue;
    for (std::size_t at = note.find(path); at != std::string::npos;
         at = note.find(path, at + name.size()))
      note.replace(at, path.size(), name);
  }
  return note;
}

}  // namespace hyperex::scene
