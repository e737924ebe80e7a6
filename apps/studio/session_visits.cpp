// SPDX-License-Identifier: GPL-3.0-or-later
// Two recordings of the open face, compared as two visits.
#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/visits/compare_visits.hpp"
#include "hyperex/visits/summary.hpp"
#include "hyperex/visits/visits_page.hpp"
#include "session.hpp"

namespace hyperex::studio {

namespace {

/// The file that moves a scene's face; empty for the embedded recording.
fs::path recording_of(const scene::MotionOptions& motion) {
  for (const fs::path& file : {motion.recording, motion.openface, motion.arkit})
    if (!file.empty()) return file;
  return motion.source.file;
}

std::string label_of(const scene::Scene& scene) {
  const fs::path file = recording_of(scene.motion);
  return file.empty() ? "embedded" : file.filename().string();
}

/// A file of points: the recording itself, or what other kinds of recording move, written there.
fs::path points_of(const scene::Scene& scene, const fs::path& written) {
  const fs::path file = recording_of(scene.motion);
  if (!file.empty() && file == scene.motion.source.file) return file;
  const session::FaceSession session(scene::Scene(scene),
                                     {.certainty = session::Certainty::on_request});
  motion::write_motion_csv(written, session.inputs().motion.motion);
  return written;
}

}  // namespace

std::string Session::earlier_recording() const {
  if (!earlier_ || !face_) return "";
  const scene::Scene earlier = scene::read_scene_text(earlier_->text, earlier_->file);
  return recording_of(earlier.motion) == recording_of(face_->scene().motion) ? ""
                                                                             : label_of(earlier);
}

json Session::compare_visits(const json& fields) {
  require_face();
  const std::string name = fields.at("name");
  check_save_name(name);
  if (earlier_recording().empty())
    throw InputError("there is one recording: drop another one of the same person on the face");
  const auto expression = visits::expression_named(fields.at("expression"));
  if (!expression)
    throw InputError(
        "expression: expected smile, show teeth, pucker, mouth open, brow raise or eye closure");
  const fs::path path = require_own(options_.save_into / (name + ".html"));
  report_progress("comparing two recordings");
  visits::VisitsFile file;
  file.file = now_.file;
  file.patient = face_->scene().title;
  file.expression = *expression;
  const scene::Scene earlier = scene::read_scene_text(earlier_->text, earlier_->file);
  for (const scene::Scene& scene : {earlier, face_->scene()}) {
    const std::string number = std::to_string(file.visits.size() + 1);
    visits::VisitEntry visit;
    visit.label = label_of(scene);
    visit.recordings = {points_of(scene, options_.folder / ("visit_" + number + ".csv"))};
    file.visits.push_back(visit);
  }
  file.unit = face_->scene().motion.unit;
  const visits::Comparison compared = visits::compare_visits(file);
  visits::write_visits_page(path, compared);
  written_.push_back(path);
  report_progress("");
  return {{"path", path}, {"sentences", visits::summary(compared)}};
}

}  // namespace hyperex::studio
