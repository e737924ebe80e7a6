// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/face_options.hpp"

#include <algorithm>
#include <utility>

#include "hyperex/session/simulation_options.hpp"

namespace hyperex::session {

simulate::SimulationOptions options_with_field(const scene::Scene& scene, const Inputs& inputs,
                                               const std::optional<tissue::TissueField>& field) {
  simulate::SimulationOptions options = simulation_options(scene, inputs);
  if (field) {
    options.tissue.element = field->element;
    options.tissue.volume_ratio = field->volume_ratio;
  }
  return options;
}

std::vector<Note> notes_on_tissue(const std::optional<tissue::TissueField>& base,
                                  const std::vector<VariantRun>& runs) {
  std::vector<Note> notes;
  if (base) notes = base->notes;
  for (const VariantRun& run : runs) {
    if (!run.field) continue;
    for (Note note : run.field->notes) {
      const bool of_base = std::ranges::count(notes, note) > 0;
      note.variant = run.scene.title;
      if (!of_base) notes.push_back(std::move(note));
    }
  }
  return notes;
}

FaceOptions face_options(const scene::Scene& scene, const Inputs& inputs, TissueFields& fields) {
  FaceOptions all;
  all.field = fields.of(scene);
  all.runs = prepare_variants(scene, inputs, fields);
  all.base = options_with_field(scene, inputs, all.field);
  simulate::check(all.base);
  for (VariantRun& run : all.runs) {
    run.options = options_with_field(run.scene, run.inputs, run.field);
    simulate::check(run.options);
  }
  return all;
}

}  // namespace hyperex::session
