// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "hyperex/core/progress.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/idle_keys.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/run_cost.hpp"

namespace hyperex::session {

std::vector<Note> check(const scene::Scene& scene, std::string* cost) {
  Progress progress("reading scan and recording", 0);
  Inputs inputs = read_inputs(scene, Extent::quick);
  const auto expected = checked_cost(scene, inputs, Extent::quick);
  if (cost && expected) *cost = sentence_of(*expected);
  std::vector<Note> notes = std::move(inputs.notes);
  notes.push_back(drive_choice(scene).note());
  append(notes, drive_warnings(scene));
  append(notes, idle_keys_warnings(scene));
  const auto has_regions = [](const scene::Scene& s) { return !s.tissue.regions.empty(); };
  if (has_regions(scene) ||
      std::any_of(scene.variants.begin(), scene.variants.end(),
                  [&](const scene::Variant& variant) { return has_regions(variant.scene); }))
    notes.push_back(make_note(
        "tissue.regions_unchecked",
        "not checked: whether the regions of the tissue lie on this scan and which values their "
        "factors lead to",
        "tissue.region"));
  return notes;
}

}  // namespace hyperex::session
