// SPDX-License-Identifier: GPL-3.0-or-later
// The notes of a session, stage by stage.
#include <algorithm>
#include <iterator>
#include <utility>

#include "hyperex/session/face_options.hpp"
#include "hyperex/session/face_session_impl.hpp"
#include "hyperex/session/run_notes.hpp"

namespace hyperex::session {

void FaceSession::Impl::begin_search() {
  if (search || searched) return;
  // Landmarks that the program found itself agree with those that it finds.
  if (scene.scan.landmarks.empty() && scene.given.landmarks.empty())
    searched = true;
  else
    search.emplace(inputs, scene.kept);
}

void FaceSession::Impl::finish_search() {
  if (!search) return;
  doubts = search->doubts(notes());
  search.reset();
  searched = true;
  report(doubts);
}

/// Notes that were reported before are not reported again.
void FaceSession::Impl::report_new(const std::vector<Note>& now,
                                   const std::vector<Note>& before) const {
  std::vector<Note> added;
  std::copy_if(now.begin(), now.end(), std::back_inserter(added), [&](const Note& note) {
    return std::find(before.begin(), before.end(), note) == before.end();
  });
  report(added);
}

/// Reports the notes on the tissue that the scene before it did not have.
void FaceSession::Impl::note_tissue() {
  const std::vector<Note> before = std::exchange(tissue_notes, notes_on_tissue(field, runs));
  report_new(tissue_notes, before);
}

/// After base was run, and again once its twin is known.
void FaceSession::Impl::note_base() {
  simulate::ContactOptions asked_for = scene.contact;
  asked_for.lips = asked_for.lips && scene.origins.contains("contact.lips");
  const std::vector<Note> before = std::exchange(
      base_notes, notes_on_contact_and_elements(simulation.report, simulation.performance,
                                                asked_for, session_options.frame_words));
  append(base_notes, gaze_notes(simulation.performance, backing ? &*backing : nullptr));
  append(base_notes, run_warnings(simulation.report, simulation.performance, scene.contact,
                                  session_options.frame_words));
  append(base_notes, symmetry_notes(symmetry, twin ? twin->why_not : ""));
  append(base_notes, volume_warnings(peak()));
  append(base_notes, strain_notes(peak()));
  report_new(base_notes, before);
}

std::vector<Note> FaceSession::Impl::notes_on_inputs(Severity severity) const {
  std::vector<Note> out = notes_of(inputs.notes, severity);
  if (severity == Severity::note)
    out.push_back(drive.note());
  else
    append(out, drive_warnings(scene));
  return out;
}

std::vector<Note> FaceSession::Impl::notes() const {
  std::vector<Note> all = notes_on_inputs(Severity::note);
  append(all, face.mesh->notes);
  append(all, notes_on_tissue(field, runs));
  append(all, teeth_notes);
  append(all, notes_on_inputs(Severity::warning));
  append(all, skin_notes);
  append(all, base_notes);
  append(all, doubts);
  append(all, variant_notes);
  return all;
}

std::vector<Note> FaceSession::notes() const {
  return impl_->notes();
}

std::vector<Note> FaceSession::warnings() const {
  return notes_of(notes(), Severity::warning);
}

}  // namespace hyperex::session
