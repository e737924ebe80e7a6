// SPDX-License-Identifier: GPL-3.0-or-later
// Two recordings of the open face, compared as two visits.
#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/scene/recording_file.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/read_recording.hpp"
#include "hyperex/session/track_recording.hpp"
#include "hyperex/visits/compare_visits.hpp"
#include "hyperex/visits/summary.hpp"
#include "hyperex/visits/visits_page.hpp"
#include "session.hpp"

namespace hyperex::studio {

namespace {

/// Whether hyperex visits could read the recording itself, and rest is its first sample.
bool is_of_points_as_recorded(const scene::MotionOptions& motion) {
  return !motion.source.file.empty() && motion.start_s == 0 && !session::rest_stretch(motion);
}

/// Writes the recorded points into the file `written`, and returns a visit that has this file.
/// Points of a table keep their head pose, which the comparison takes out: taken out before, by
/// other points, it would make other figures than hyperex visits. Points are not aligned with the
/// scan: that would give both visits the same face at rest.
visits::VisitEntry visit_of(const scene::Scene& scene, session::Inputs inputs,
                            const fs::path& written) {
  const motion::Motion recorded = session::read_motion(scene, session::Extent::full, inputs);
  motion::write_motion_csv(
      written, is_of_points_as_recorded(scene.motion)
                   ? recorded
                   : session::steady_motion(scene, recorded, session::Extent::full, inputs).motion);
  visits::VisitEntry visit;
  visit.label = scene::recording_file(scene.motion).filename().string();
  visit.recordings = {written};
  return visit;
}

}  // namespace

std::string Session::earlier_recording() const {
  if (!earlier_ || !face_) return "";
  const scene::Scene earlier = scene::read_scene_text(earlier_->text, earlier_->file);
  const fs::path before = scene::recording_file(earlier.motion),
                 now = scene::recording_file(face_->scene().motion);
  // The smiles that the studio brings are no patient's.
  for (const fs::path& file : {before, now})
    if (file.empty() || file == options_.folder / "smile_arkit.csv") return "";
  return before == now ? "" : before.filename().string();
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
  if (face_->scene().output.repetition_m > 0)
    file.repetition_m = face_->scene().output.repetition_m;
  scene::Scene earlier = scene::read_scene_text(earlier_->text, earlier_->file);
  earlier.kept = options_.kept;
  const session::FaceSession before(scene::Scene(earlier),
                                    {.certainty = session::Certainty::on_request});
  file.visits = {visit_of(earlier, before.inputs(), options_.folder / "visit_1.csv"),
                 visit_of(face_->scene(), face_->inputs(), options_.folder / "visit_2.csv")};
  const visits::Comparison compared = visits::compare_visits(file);
  visits::write_visits_page(path, compared);
  written_.push_back(path);
  report_progress("");
  return {{"path", path}, {"sentences", visits::summary(compared)}};
}

}  // namespace hyperex::studio
