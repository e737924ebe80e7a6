// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/variants.hpp"

#include <fmt/format.h>

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
    run.field = fields.of(variant.scene, fmt::format("variant[{}].", runs.size()));
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace hyperex::session
