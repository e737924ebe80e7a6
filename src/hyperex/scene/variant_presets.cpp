// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/variant_presets.hpp"

#include <stdexcept>
#include <string_view>

#include "hyperex/core/carried_file.hpp"
#include "hyperex/scene/toml_values.hpp"

namespace hyperex::scene {

HX_CARRIED_FILE(variant_presets_toml, HYPEREX_VARIANT_PRESETS)

namespace {
using nlohmann::json;

std::string on_the_left(std::string name) {
  if (name.ends_with("_R")) name.back() = 'L';
  return name;
}

json mirrored(const json& value) {
  if (value.is_string()) return on_the_left(value.get<std::string>());
  json out = value;
  if (value.is_array())
    for (json& item : out) item = mirrored(item);
  if (value.is_object()) {
    out = json::object();
    for (const auto& [key, item] : value.items()) out[on_the_left(key)] = mirrored(item);
  }
  return out;
}

std::vector<VariantPreset> read_presets() {
  std::vector<VariantPreset> out;
  const std::string text(variant_presets_toml());
  try {
    const json root = parse_toml(text).root;
    for (const json& one : root.at("preset")) {
      VariantPreset preset{one.at("name"), one.at("summary"), one.at("source"), one.at("assumed"),
                           one.at("change")};
      if (!one.at("sided").get<bool>()) {
        out.push_back(std::move(preset));
        continue;
      }
      VariantPreset left = preset;
      preset.name += "_R";
      left.name += "_L";
      left.changes = mirrored(left.changes);
      out.push_back(std::move(preset));
      out.push_back(std::move(left));
    }
  } catch (const TornToml&) {  // our own file: an error in it is an error of the build
    throw std::logic_error("the presets of variants inside this program are damaged");
  }
  return out;
}

}  // namespace

const std::vector<VariantPreset>& variant_presets() {
  static const std::vector<VariantPreset> presets = read_presets();
  return presets;
}

const VariantPreset* find_variant_preset(const std::string& name) {
  for (const VariantPreset& preset : variant_presets())
    if (preset.name == name) return &preset;
  return nullptr;
}

}  // namespace hyperex::scene
