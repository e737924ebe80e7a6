// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/presets.hpp"

#include <fmt/format.h>

#include <iostream>

#include "commands.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/scene/override.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/scene/variant_presets.hpp"
#include "hyperex/tissue/field/facial_regions.hpp"

namespace hyperex::cli {
namespace {

std::string values_of(const tissue::GivenParameters& given, const char* ending) {
  std::string text;
  for (int p = 0; p < tissue::parameter_count; ++p)
    if (given[p])
      text += fmt::format("{}{} = {:g}", text.empty() ? "" : ", ",
                          *ending ? tissue::factor_key(p) : tissue::parameter_info(p).key,
                          *ending ? *given[p] : *given[p] / tissue::parameter_info(p).si);
  return text;
}

/// "  layer skin: 1.74 mm, young_factor = 1.272".
std::string layer_text(const tissue::TissueLayer& layer) {
  std::string text = layer.thickness_m
                         ? fmt::format("{:g} mm", kMillimetres.from_si(*layer.thickness_m))
                         : "the rest";
  for (const std::string& values : {values_of(layer.value, ""), values_of(layer.factor, "*")})
    if (!values.empty()) text += ", " + values;
  return fmt::format("  layer {}: {}\n", layer.name, text);
}

/// Prints the names that muscles.gain accepts.
void print_muscles() {
  std::cout
      << "\nMuscles, for muscles.gain; with _L or _R the subject's own side. The branch of the "
         "facial nerve, with _L or _R, stands for all its muscles on that side; side_L and "
         "side_R for all of a side\n\n";
  for (const muscles::TemplateMuscle& muscle : muscles::muscle_template())
    std::cout << fmt::format("{:14} {:11} {}\n", muscle.name, muscle.branch, muscle.latin);
}

void print_presets() {
  std::cout << "Presets, for tissue.preset\n";
  for (const tissue::TissuePreset& preset : tissue::tissue_presets()) {
    std::cout << fmt::format("\n{}: {}\n  source: {}\n", preset.name, preset.summary,
                             preset.source);
    const std::string uniform = values_of(preset.uniform, ""),
                      factor = values_of(preset.factor, "*");
    if (!uniform.empty()) std::cout << "  everywhere: " << uniform << '\n';
    if (!factor.empty()) std::cout << "  everything: " << factor << '\n';
    for (const tissue::TissuePoint& point : preset.points)
      std::cout << fmt::format("  {}: {}\n", point.landmark, values_of(point.value, ""));
    for (const tissue::TissueLayer& layer : preset.layers) std::cout << layer_text(layer);
  }
  std::cout << "\nPresets, for preset in [[variant]]\n";
  for (const scene::VariantPreset& preset : scene::variant_presets()) {
    std::cout << fmt::format("\n{}: {}\n  source: {}\n  assumed: {}\n", preset.name, preset.summary,
                             preset.source, preset.assumed);
    for (const auto& [key, value] : scene::changes_of(preset.changes))
      std::cout << fmt::format("  {} = {}\n", key, scene::toml_text(value));
  }
  std::cout << "\nRegions, for name in [[tissue.region]]; with _L or _R the subject's own left or "
               "right half\n\n";
  for (const tissue::FacialRegion& region : tissue::facial_regions())
    std::cout << fmt::format("{:10} {}\n", region.name, region.meaning);
  print_muscles();
}

}  // namespace

void add_presets(CLI::App& program) {
  program
      .add_subcommand(
          "presets",
          "List published tissue parameters and presets of variants (palsies, scar, age) "
          "with their sources, the named regions of the face, and the muscles")
      ->footer("Example: hyperex presets")
      ->callback(print_presets);
}

}  // namespace hyperex::cli
