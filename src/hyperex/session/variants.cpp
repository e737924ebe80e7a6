// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/variants.hpp"

#include <fmt/format.h>

#include "hyperex/core/printable.hpp"

namespace hyperex::session {

std::vector<VariantRun> prepare_variants(const scene::Scene& scene, const Inputs& inputs,
                                         TissueFields& fields) {
  std::vector<VariantRun> runs;
  for (const scene::Variant& variant : scene.variants) {
    VariantRun run;
    run.scene = variant.scene;
    run.scene.title = variant.name;
    run.folder = variant.folder;
    run.scene.output.vtu = run.scene.output.vtu && run.scene.output.variants_vtu;
    run.scene.output.report = false;
    run.inputs = inputs_of_variant(variant.scene, inputs);
    run.field = fields.of(variant.scene, variant.owner());
    runs.push_back(std::move(run));
  }
  return runs;
}

Note left_out_warning(const scene::LeftOutVariant& variant) {
  constexpr std::size_t most_quoted = 100;
  std::string why = variant.why;
  for (auto at = why.find('\n'); at != std::string::npos; at = why.find('\n', at))
    why.replace(at, 1, "; ");
  return make_warning(
      "variant.left_out",
      fmt::format("variant {} cannot be run and is left out here; a saved scene keeps it: {}",
                  variant.name.empty()
                      ? fmt::format("number {}", variant.number + 1)
                      : printable(nlohmann::json(variant.name).dump(), most_quoted),
                  why));
}

}  // namespace hyperex::session
