// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hyperex::scene {

/// A `preset` of a [[variant]] (data/variant_presets.toml, which is part of the program).
struct VariantPreset {
  std::string name;     ///< "palsy_complete_R" (of a side) or "aged"
  std::string summary;  ///< one line each
  std::string source, assumed;
  nlohmann::json changes;  ///< as a variant would have them: {"muscles": {"gain": {"side_R": 0}}}
};

/// All presets. Those of a side exist for both sides, right before left.
const std::vector<VariantPreset>& variant_presets();
/// Null where there is none of this name.
const VariantPreset* find_variant_preset(const std::string& name);
/// The expected text for the name of no preset: "another name; did you mean palsy_partial_L?" for
/// "palsy_incomplete_L" and for names with one or two slips, else the list of all. A side is never
/// guessed.
std::string expected_preset(const std::string& name);

}  // namespace hyperex::scene
