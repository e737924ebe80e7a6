// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hyperex::scene {

/// What `preset` of a [[variant]] stands for (data/variant_presets.toml, carried inside the
/// program).
struct VariantPreset {
  std::string name;     ///< "palsy_complete_R": of a side, or "aged"
  std::string summary;  ///< one line each
  std::string source, assumed;
  nlohmann::json changes;  ///< as a variant would have them: {"muscles": {"gain": {"side_R": 0}}}
};

/// Those of a side for either of them, right before left.
const std::vector<VariantPreset>& variant_presets();
/// Null where there is none of this name.
const VariantPreset* find_variant_preset(const std::string& name);

}  // namespace hyperex::scene
