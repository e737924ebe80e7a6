// SPDX-License-Identifier: GPL-3.0-or-later
// What the page receives without a request.
#include <fmt/format.h>

#include <algorithm>

#include "bones_message.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/muscles/fold_pull.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/session/remarks_json.hpp"
#include "hyperex/uncertainty/budget_outputs.hpp"
#include "session.hpp"
#include "shape_message.hpp"

namespace hyperex::studio {

namespace {

json muscles_json(const muscles::MuscleTable& table) {
  json out = json::array();
  for (const muscles::TemplateMuscle& muscle : table)
    out.push_back({{"name", muscle.name},
                   {"latin", muscle.latin},
                   {"group", muscle.group},
                   {"branch", muscle.branch}});
  return {{"muscles", out}, {"names", muscles::gain_names(table)}};
}

/// The scan's landmarks, and those of the fold at the places that the rule gives them.
json landmarks_json(const OpenFace& of) {
  const io::Landmarks& known = of.inputs().landmarks;
  const std::vector<std::string>& placed = of.inputs().placed;
  const bool none_given = of.scene().scan.landmarks.empty();
  json out = json::array();
  const auto add = [&](const std::string& name, const Vec3& place, bool found) {
    out.push_back({{"name", name},
                   {"other", face::mirrored_landmark(name)},
                   {"position", {place.x(), place.y(), place.z()}},
                   {"found", found}});
  };
  for (const auto& [name, place] : known)
    add(name, place, none_given || std::count(placed.begin(), placed.end(), name) > 0);
  for (const auto& [name, place] : muscles::fold_places(of.session().mesh(), known))
    add(name, place, true);
  return out;
}

}  // namespace

void Session::send_motion(Stopwatch& watch) {
  report::BinaryBlock block;
  json head = {{"event", face_sent_ ? "motion" : "face"}};
  head["replay"] = face_->replay(block, !face_sent_);
  for (const json more = session::remarks_json(left_out_.notes); const json& remark : more)
    head["replay"]["summary"]["remarks"].push_back(remark);
  head["activations"] = face_->activations(block);
  if (face_sent_) {
    head["table"] = head["replay"]["summary"].contains("variants")
                        ? head["replay"]["summary"]["variants"]["table"]
                        : json::array();
    head["seconds"] = watch.lap();
    head["bands"] = face_->session().certainty_known();
  } else {
    head["landmarks"] = landmarks_json(*face_);
    for (const std::string& name : face::optional_landmarks())
      head["replay"]["point_words"][name] = face::point_words(name);
    head["muscles"] = muscles_json(face_->scene().muscles.table());
    head["bones"] = bones_json(face_->session().mesh(), face_->inputs().landmarks, block);
    const Eigen::VectorXf thickness = face_->unpainted_mm();
    head["thickness"] = block.add("float32", thickness.data(), std::size_t(thickness.size()));
  }
  send_(binary_message(head, block), true, "");
  if (!face_sent_) send_ct_pictures();
  face_sent_ = true;
}

void Session::send_budget(const uncertainty::FaceBudget& budget) {
  const json known = uncertainty::budget_json(budget);
  const json event = {{"event", "budget"},
                      {"figures", known.at("corners_of_the_mouth")},
                      {"missing", known.at("missing")},
                      {"jitter_known", known.at("jitter_known")},
                      {"text", text_to_save()}};
  send_(event.dump(-1, ' ', false, json::error_handler_t::replace), false, "");
}

void Session::send_scene() {
  const scene::Scene& scene = face_->scene();
  json values = json::array({values_of(scene)});
  json faces = json::array({{{"name", "base"}, {"changes", json::object()}}});
  for (const scene::Variant& variant : scene.variants) {
    values.push_back(values_of(variant.scene));
    faces.push_back({{"name", variant.name}, {"changes", variant.changes}});
  }
  const std::vector<json> blocks = scene::variant_blocks(face_->text());
  for (std::size_t i = 0; i < blocks.size() && i + 1 < faces.size(); ++i)
    if (blocks[i].contains("preset")) faces[i + 1]["preset"] = blocks[i]["preset"];
  const json event = {{"event", "scene"},
                      {"title", scene.title},
                      {"values", values},
                      {"faces", faces},
                      {"points", face_->session().inputs().motion.motion.names},
                      {"drive", values[0]["drive.by"]},
                      {"drive_why", face_->session().drive_reason()},
                      {"earlier", earlier_recording()},
                      {"can_undo", !undo_.empty()},
                      {"can_redo", !redo_.empty()},
                      {"saved", saved_},
                      {"text", text_to_save()}};
  send_(event.dump(-1, ' ', false, json::error_handler_t::replace), false, "scene");
}

void Session::send_shape(std::size_t face, double time_s) {
  Stopwatch watch;
  if (face >= face_->session().faces()) throw InputError("face: there is none of this number");
  const bool first = !face_->session().ready(face);
  if (first) report_progress("finding the forces that move the face");
  const PointsF shape = face_->session().still(face, time_s);
  if (first) report_progress("");
  report::BinaryBlock block;
  json head = {{"event", "shape"}, {"face", face}, {"time_s", time_s}};
  add_shape(shape, block, head);
  head["seconds"] = watch.lap();
  send_(binary_message(head, block), true, fmt::format("shape-{}", face));
}

void Session::report_progress(const std::string& stage, double share) {
  const json event = {{"event", "progress"}, {"stage", stage}, {"share", share}};
  send_(event.dump(), false, "progress");
}

std::string Session::without_folder(std::string text) const {
  const fs::path& folder = options_.folder;
  for (const std::string& path : {(folder / "uploads").string() + "/", folder.string() + "/"})
    for (auto at = text.find(path); at != std::string::npos; at = text.find(path, at))
      text.erase(at, path.size());
  return text;
}

void Session::log(const char* level, const std::string& text) {
  const json event = {{"event", "log"}, {"level", level}, {"text", text}};
  send_(event.dump(-1, ' ', false, json::error_handler_t::replace), false, "");
}

}  // namespace hyperex::studio
