// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/setting_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hyperex/core/add_rest.hpp"
#include "hyperex/tissue/field/layers.hpp"

namespace hyperex::run {
namespace {

/// More gains than these are counted, not named.
constexpr std::size_t kNamedGains = 6;
/// A depth below this would be printed as 0.00 mm.
constexpr double kPrintedDepth_mm = 0.005;

/// "side_L": "left side"; "zygomatic_R": "zygomatic (right)".
std::string gained_muscle(const std::string& name) {
  const bool left = name.ends_with("_L");
  if (!left && !name.ends_with("_R")) return name;
  const char* side = left ? "left" : "right";
  const std::string muscle = name.substr(0, name.size() - 2);
  return muscle == "side" ? fmt::format("{} side", side) : fmt::format("{} ({})", muscle, side);
}

/// Empty where all gains are 1.
std::string gains_line(const std::vector<simulate::MuscleGain>& gains) {
  std::vector<std::string> named;
  std::size_t count = 0;
  for (const simulate::MuscleGain& one : gains)
    if (one.gain != 1 && ++count <= kNamedGains)
      named.push_back(fmt::format("{} by {:g}", gained_muscle(one.muscle), one.gain));
  if (named.empty()) return "";
  add_rest(named, count);
  return fmt::format("muscles.gain multiplies activations: {}", fmt::join(named, ", "));
}

/// Empty where preset and layers are the default.
std::string tissue_line(const scene::Scene& scene) {
  std::vector<std::string> parts;
  if (!scene.tissue.preset.empty()) parts.push_back("preset " + scene.tissue.preset);
  if (const std::size_t layers = tissue::layer_parameters(scene.tissue).size(); layers > 1)
    parts.push_back(fmt::format("{} layers of tissue", layers));
  if (scene.mesh.layers != tissue::TissueMeshOptions().layers)
    parts.push_back(fmt::format("{} layer{} of elements", scene.mesh.layers,
                                scene.mesh.layers == 1 ? "" : "s"));
  return parts.empty() ? "" : fmt::format("tissue: {}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<std::string> setting_lines(const scene::Scene& scene) {
  std::vector<std::string> lines;
  for (std::string line : {gains_line(scene.muscles.gains), tissue_line(scene)})
    if (!line.empty()) lines.push_back(std::move(line));
  if (scene.contact.lips && !scene.origins.contains("contact.lips"))
    lines.emplace_back(
        "the lips are kept from passing through each other, the default (contact.lips = false "
        "turns it off)");
  return lines;
}

std::string contact_line(const nlohmann::ordered_json& summary) {
  if (!summary.contains("contact")) return "";
  const auto& contact = summary["contact"];
  const int frames = contact.value("frames", 0);
  if (frames == 0) return "";
  std::vector<std::string> depths;
  const auto add = [&](const std::string& key, const char* words) {
    const double without_mm = contact.value(key + "_without_mm", 0.0);
    if (without_mm >= kPrintedDepth_mm)
      depths.push_back(fmt::format("{} by up to {:.2f} mm (now {:.2f} mm)", words, without_mm,
                                   contact.value(key + "_mm", 0.0)));
  };
  add("lip_overlap", "the lips would overlap");
  add("in_teeth", "tissue would be in the teeth");
  add("in_eyes", "the lids would be in the eyes");
  return fmt::format("contact acted in {} frame{}{}{}\n", frames, frames == 1 ? "" : "s",
                     depths.empty() ? "" : ": ", fmt::join(depths, ", "));
}

}  // namespace hyperex::run
