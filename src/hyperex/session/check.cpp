// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>
#include <utility>

#include "hyperex/core/progress.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/run_cost.hpp"
#include "hyperex/session/try_face.hpp"

namespace hyperex::session {
namespace {

Inputs inputs_of(const scene::Scene& scene, CheckDepth depth) {
  std::optional<Progress> progress;
  // A search for landmarks has a bar of its own.
  const bool search = depth == CheckDepth::face && scene.scan.landmarks.empty() &&
                      scene.given.landmarks.empty() && !scene.scan.source.embedded;
  if (!search) progress.emplace("reading scan and recording", 0);
  return read_inputs(scene, search ? Extent::searched : Extent::quick);
}

}  // namespace

std::vector<Note> check(const scene::Scene& scene, std::string* cost, CheckDepth depth) {
  Inputs inputs = inputs_of(scene, depth);
  const auto expected = checked_cost(scene, inputs, Extent::quick);
  if (cost && expected) *cost = sentence_of(*expected);
  std::vector<Note> notes = inputs.notes;
  notes.push_back(drive_choice(scene).note());
  append(notes, drive_warnings(scene));
  if (depth == CheckDepth::face) append(notes, try_face(scene, std::move(inputs)));
  return notes;
}

}  // namespace hyperex::session
