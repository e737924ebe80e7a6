// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/given_text.hpp"

#include <algorithm>

#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/scene_text.hpp"

namespace hyperex::scene {
namespace {
using nlohmann::json;

/// Makes paths absolute: as read they may be relative to the current folder, while paths in a scene
/// file are relative to that file.
void make_absolute(const KeyInfo& info, json& value) {
  if (info.kind == Kind::path && value.is_string() && !value.get<std::string>().empty() &&
      std::find(info.choices.begin(), info.choices.end(), value) == info.choices.end())
    value = std::filesystem::absolute(value.get<std::string>()).generic_string();
  for (const KeyInfo& column : info.columns)
    for (json& row : value)
      if (row.contains(column.name)) make_absolute(column, row[column.name]);
}

}  // namespace

void put_value(json& table, const std::string& key, json value) {
  const std::string section = section_of(key);
  if (section.empty())
    table[key] = std::move(value);
  else
    table[section][key.substr(section.size() + 1)] = std::move(value);
}

std::string given_text(const Scene& scene) {
  json root = json::object();
  for (const Key& key : keys()) {
    if (!scene.origins.contains(key.name)) continue;
    json value = key.get(scene);
    make_absolute(key, value);
    put_value(root, key.name, std::move(value));
  }
  json variants = json::array();
  for (const Variant& variant : scene.variants) {
    json block = {{"name", variant.name}};
    for (const auto& [key, given] : variant.changes.items()) {
      json value = given;
      if (const Key* known = find_key(key); known && variant.scene.origins.contains(key)) {
        value = known->get(variant.scene);
        make_absolute(*known, value);
      }
      put_value(block, key, std::move(value));
    }
    variants.push_back(std::move(block));
  }
  if (!variants.empty()) root["variant"] = std::move(variants);
  return toml_document(root);
}

}  // namespace hyperex::scene
