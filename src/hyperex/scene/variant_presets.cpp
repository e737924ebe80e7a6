// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/variant_presets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string_view>
#include <utility>

#include "hyperex/core/carried_file.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/slips.hpp"
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

/// In lower case, with the words that the presets use: "palsy_incomplete_left" is
/// "palsy_partial_l".
std::string in_words_of_presets(const std::string& name) {
  std::string out = lower_case(name).substr(0, 100);
  for (const auto& [word, ours] : {std::pair<std::string, std::string>{"incomplete", "partial"},
                                   {"total", "complete"},
                                   {"paralysis", "palsy"},
                                   {"left", "l"},
                                   {"right", "r"}})
    if (const auto at = out.find(word); at != std::string::npos) out.replace(at, word.size(), ours);
  return out;
}

bool has_side(const std::string& lower_name, char side) {
  return lower_name.ends_with(std::string("_") + side);
}

/// Those meant by a name of no preset: one, the two sides of one, or none.
std::vector<std::string> presets_meant(const std::string& name) {
  constexpr std::size_t most_slips = 2;  // of more, another word is likely
  const std::string given = in_words_of_presets(name);
  std::vector<std::string> meant;
  std::size_t fewest = most_slips + 1;
  for (const VariantPreset& preset : variant_presets()) {
    std::string theirs = lower_case(preset.name);
    const bool given_sided = has_side(given, 'r') || has_side(given, 'l');
    if (!given_sided && (has_side(theirs, 'r') || has_side(theirs, 'l')))
      theirs.resize(theirs.size() - 2);
    else if (has_side(given, 'r') != has_side(theirs, 'r'))
      continue;
    const std::size_t far = slips(given, theirs);
    if (far > fewest || far > most_slips) continue;
    if (far < fewest) meant.clear();
    fewest = far;
    meant.push_back(preset.name);
  }
  return meant;
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

std::string expected_preset(const std::string& name) {
  if (const auto meant = presets_meant(name); !meant.empty())
    return fmt::format("another name; did you mean {}?", fmt::join(meant, " or "));
  std::vector<std::string> all;
  for (const VariantPreset& preset : variant_presets()) all.push_back(preset.name);
  return fmt::format("one of {}", fmt::join(all, ", "));
}

}  // namespace hyperex::scene
