// SPDX-License-Identifier: GPL-3.0-or-later
// Two recordings of the open face, compared as two visits.
#include <fmt/format.h>

#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/fill_gaps.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/still_points.hpp"
#include "hyperex/scene/recording_file.hpp"
#include "hyperex/session/cleaned_recording.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/read_recording.hpp"
#include "hyperex/session/recording_names.hpp"
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

/// One of the recordings that are compared.
struct ComparedRecording {
  const scene::Scene* its_scene;
  visits::VisitEntry visit;
  motion::Motion points;
  std::vector<std::string> by_hand;  ///< points that the user chose to hold the head; or empty
};

/// The points that the scene names to hold the head, if they are others than the studio itself
/// names. Weights move a face whose head is still.
std::vector<std::string> points_by_hand(const scene::Scene& scene, const motion::Motion& recorded) {
  const std::vector<std::string>& named = scene.motion.rigid_points;
  if (named.empty() || scene::of_weights(scene)) return {};
  const std::vector<std::string> found = session::points_to_hold_the_head(recorded).names;
  return std::set(named.begin(), named.end()) == std::set(found.begin(), found.end())
             ? std::vector<std::string>()
             : named;
}

/// The recorded points, and a visit that has the file `written`, which write_points() writes.
/// Points of a table keep their head pose, which the comparison takes out: taken out before, by
/// other points, it would make other figures than hyperex visits. Points are not aligned with the
/// scan: that would give both visits the same face at rest.
ComparedRecording visit_of(const scene::Scene& scene, session::Inputs inputs,
                           const fs::path& written) {
  ComparedRecording out{&scene, {}, session::read_motion(scene, session::Extent::full, inputs), {}};
  out.by_hand = points_by_hand(scene, out.points);
  if (!is_of_points_as_recorded(scene.motion))
    out.points = session::steady_motion(scene, out.points, session::Extent::full, inputs).motion;
  out.visit.label = scene::recording_file(scene.motion).filename().string();
  out.visit.recordings = {written};
  return out;
}

/// The points that hold the head in both recordings: those that the user chose for the present one,
/// else for the one before; empty: none were chosen, or weights moved one of the faces, whose head
/// is still. Throws InputError where a recording lacks one.
std::vector<std::string> chosen_points(const ComparedRecording& before,
                                       const ComparedRecording& now) {
  if (scene::of_weights(*before.its_scene) || scene::of_weights(*now.its_scene)) return {};
  const std::vector<std::string>& chosen = now.by_hand.empty() ? before.by_hand : now.by_hand;
  for (const ComparedRecording* one : {&before, &now})
    for (const std::string& name : motion::own_names(one->points, chosen))
      if (one->points.index_of(name) < 0)
        throw InputError(
            fmt::format("{} has no point {}, which was chosen to hold the head; choose points that "
                        "both recordings have (motion.rigid_points)",
                        one->visit.label, name));
  return chosen;
}

/// Fills the gaps of the points `names`, as a run does: the comparison takes the head's pose from
/// them in every sample. Other points keep theirs, as in hyperex visits.
void fill_gaps_of(const std::vector<std::string>& names, double max_gap_s, motion::Motion& points) {
  const motion::Motion cleaned = session::cleaned_recording(points).motion,
                       filled = motion::fill_gaps(cleaned, {.max_gap_s = max_gap_s}).motion;
  for (const std::string& name : motion::own_names(points, names)) {
    const int row = points.index_of(name);
    for (std::size_t k = 0; k < points.positions.size(); ++k)
      if (!cleaned.positions[k].row(row).allFinite())
        points.positions[k].row(row) = filled.positions[k].row(row);
  }
}

/// Writes the file of the visit. `holding_head`: the chosen points.
void write_points(ComparedRecording& recording, const std::vector<std::string>& holding_head) {
  const scene::MotionOptions& motion = recording.its_scene->motion;
  if (!holding_head.empty() && is_of_points_as_recorded(motion))
    fill_gaps_of(holding_head, motion.max_gap_s, recording.points);
  motion::write_motion_csv(recording.visit.recordings.front(), recording.points);
}

/// The page itself, or one beside it with a number where that is there: "visits-smile-2.html". A
/// page of an earlier comparison may be all that is left of it.
fs::path free_page(const fs::path& wanted) {
  fs::path page = wanted;
  for (int n = 2; fs::exists(fs::symlink_status(page)); ++n)
    page = wanted.parent_path() / fmt::format("{}-{}.html", wanted.stem().string(), n);
  return page;
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
  const fs::path path = free_page(require_own(options_.save_into / (name + ".html")));
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
  ComparedRecording first = visit_of(earlier, before.inputs(), options_.folder / "visit_1.csv");
  ComparedRecording second =
      visit_of(face_->scene(), face_->inputs(), options_.folder / "visit_2.csv");
  file.visits = {first.visit, second.visit};
  file.rigid_points = chosen_points(first, second);
  for (ComparedRecording* recording : {&first, &second})
    write_points(*recording, file.rigid_points);
  const visits::Comparison compared = visits::compare_visits(file);
  visits::write_visits_page(path, compared);
  written_.push_back(path);
  report_progress("");
  return {{"path", path}, {"sentences", visits::summary(compared)}};
}

}  // namespace hyperex::studio
