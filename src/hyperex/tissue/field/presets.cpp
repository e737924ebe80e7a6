// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/presets.hpp"

#include <stdexcept>

#include "hyperex/io/toml.hpp"
#include "hyperex/tissue/field/data.hpp"

namespace hyperex::tissue {
namespace {

GivenParameters values_of(const toml::table& table) {
  GivenParameters given{};
  for (int p = 0; p < parameter_count; ++p)
    if (const auto value = table[parameter_info(p).key].value<double>())
      given[p] = *value * parameter_info(p).si;
  return given;
}

GivenParameters factors_of(const toml::table& table) {
  GivenParameters given{};
  for (int p = 0; p < parameter_count; ++p) given[p] = table[factor_key(p)].value<double>();
  return given;
}

std::string text_of(const toml::table& table, const char* key) {
  return table[key].value_or(std::string());
}

TissuePreset preset_of(const toml::table& table) {
  TissuePreset preset{text_of(table, "name"),
                      text_of(table, "summary"),
                      text_of(table, "source"),
                      values_of(table),
                      factors_of(table),
                      {},
                      {}};
  if (const auto* points = table["point"].as_array())
    for (const auto& entry : *points) {
      const toml::table& point = *entry.as_table();
      preset.points.push_back({text_of(point, "landmark"), "", values_of(point)});
    }
  if (const auto* layers = table["layer"].as_array())
    for (const auto& entry : *layers) {
      const toml::table& layer = *entry.as_table();
      TissueLayer& own = preset.layers.emplace_back();
      own = {text_of(layer, "name"), std::nullopt, values_of(layer), factors_of(layer)};
      if (const auto mm = layer["thickness_mm"].value<double>())
        own.thickness_m = kMillimetres.to_si(*mm);
    }
  // Our own file: a fault in it is a fault of the build.
  if (preset.name.empty() || preset.source.empty())
    throw std::logic_error("the tissue presets inside this program are damaged");
  return preset;
}

}  // namespace

const std::vector<TissuePreset>& tissue_presets() {
  static const std::vector<TissuePreset> presets = [] {
    std::vector<TissuePreset> list;
    const toml::table file = toml::parse(presets_toml());
    for (const auto& entry : *file["preset"].as_array())
      list.push_back(preset_of(*entry.as_table()));
    return list;
  }();
  return presets;
}

const TissuePreset* find_preset(const std::string& name) {
  for (const TissuePreset& preset : tissue_presets())
    if (preset.name == name) return &preset;
  return nullptr;
}

TissueParameters uniform_parameters(const TissueFieldOptions& options) {
  TissueParameters values = default_parameters;
  const TissuePreset* preset = find_preset(options.preset);
  for (int p = 0; p < parameter_count; ++p) {
    if (preset && preset->uniform[p]) values[p] = *preset->uniform[p];
    if (options.uniform[p]) values[p] = *options.uniform[p];
    if (preset && preset->factor[p]) values[p] *= *preset->factor[p];
  }
  return values;
}

}  // namespace hyperex::tissue
