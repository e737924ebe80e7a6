// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::run {

/// Lines for the terminal, without ends. Gains other than 1: "muscles.gain multiplies activations:
/// left side by 0.6, zygomatic (right) by 1.2". Settings of the tissue that are not the default:
/// "tissue: preset skin_fat_deep, 3 layers of tissue, 4 layers of elements". Contact of the lips,
/// where it is on by default and not by a key of the scene.
std::vector<std::string> setting_lines(const scene::Scene& scene);

/// One line from a run's summary on what contact did to its own face, not to its variants: "contact
/// acted in 12 frames: the lips would overlap by up to 0.34 mm (now 0.01 mm)". Empty where it never
/// acted, or is off.
std::string contact_line(const nlohmann::ordered_json& summary);

}  // namespace hyperex::run
