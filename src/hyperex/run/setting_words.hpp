// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::run {

/// Lines for the terminal, without ends, on what a scene changes and what it has by default:
/// "muscles.gain multiplies activations: left side by 0.6, zygomatic (right) by 1.2" where a gain
/// is not 1, "tissue: preset skin_fat_deep, 3 layers of tissue, 4 layers of elements" of what is
/// not the default, and that the lips are kept apart where no key says so.
std::vector<std::string> setting_lines(const scene::Scene& scene);

/// One line from a run's summary on what contact did to its own face, not to its variants: "contact
/// acted in 12 frames: the lips would overlap by up to 0.34 mm (now 0.01 mm)". Empty where it never
/// acted, or is off.
std::string contact_line(const nlohmann::ordered_json& summary);

}  // namespace hyperex::run
