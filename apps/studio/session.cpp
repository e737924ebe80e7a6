// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/run/pipeline.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/new_scene.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "scene_files.hpp"
#include "server.hpp"
#include "shape_message.hpp"

namespace hyperex::studio {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostSteps = 500;

json muscles_json(const muscles::MuscleTable& table) {
  json out = json::array();
  for (const muscles::TemplateMuscle& muscle : table)
    out.push_back({{"name", muscle.name},
                   {"latin", muscle.latin},
                   {"group", muscle.group},
                   {"branch", muscle.branch}});
  return {{"muscles", out}, {"names", muscles::gain_names(table)}};
}

bool changes_muscles(const json& changes) {
  for (const auto& [key, value] : changes.items())
    if (key.rfind("muscles.", 0) == 0 && !value.is_null()) return true;
  return false;
}

/// Files of the session's own folder by their names alone: nobody knows where it lies.
std::string without_folder(std::string text, const fs::path& folder) {
  const std::string path = folder.string() + "/";
  for (auto at = text.find(path); at != std::string::npos; at = text.find(path, at))
    text.erase(at, path.size());
  return text;
}

bool is_zip(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".zip";
}

}  // namespace

Session::Session(SessionOptions options, Send send)
    : options_(std::move(options)), send_(std::move(send)) {}

void Session::answer(const Request& request) {
  json out;
  const std::string& name = request.name;
  const json& fields = request.fields;
  try {
    if (name == "hello")
      out = hello();
    else if (name == "open")
      out = open(fields);
    else if (name == "set")
      out = set(fields);
    else if (name == "add_variant")
      out = add_variant(fields);
    else if (name == "remove_variant")
      out = remove_variant(fields);
    else if (name == "rename_variant")
      out = rename_variant(fields);
    else if (name == "paint")
      out = paint(fields);
    else if (name == "region_shares")
      out = region_shares(fields);
    else if (name == "undo")
      out = undo_or_redo(undo_, redo_);
    else if (name == "redo")
      out = undo_or_redo(redo_, undo_);
    else if (name == "move_landmark")
      out = move_landmark(fields);
    else if (name == "landmarks_done")
      out = landmarks_done();
    else if (name == "free_name")
      out = free_name(fields);
    else if (name == "discard_autosave")
      out = discard_autosave();
    else if (name == "save")
      out = save(fields);
    else if (name == "live_start")
      out = live_start(fields);
    else if (name == "live_stop")
      end_live(), out = json::object();
    else if (name == "live_neutral")
      need_live().set_neutral(), out = json::object();
    else if (name == "live_record")
      need_live().record(fields.at("on")), out = json::object();
    else if (name == "live_drawn")
      drawn(fields.at("frame")), out = json::object();
    else if (name == "live_take")
      out = live_take(fields);
    else
      throw InputError(name + ": this studio does not know how to do that yet");
  } catch (const scene::TornToml& torn) {
    tell("");
    out = {{"error", fmt::format("line {}: no sound TOML: {}", torn.line, torn.why)}};
  } catch (const std::exception& error) {
    tell("");
    out = {{"error", without_folder(error.what(), options_.folder)}};
  }
  out["answer"] = request.id;
  send_(out.dump(-1, ' ', false, json::error_handler_t::replace), false, "");
  if (name == "hello" && face_) send_scene();
  if (name == "hello" && live_) live_->tell();
}

OpenFace& Session::need_face() {
  if (!face_) throw InputError("no face is open: open one first");
  return *face_;
}

std::vector<std::string> Session::known_paths() const {
  const scene::Scene committed = scene::read_scene_text(now_.text, now_.file);
  std::vector<std::string> known = paths_of(options_json(committed));
  for (const scene::Variant& variant : committed.variants)
    for (const std::string& path : paths_of(options_json(variant.scene))) known.push_back(path);
  return known;
}

json Session::open(const json& fields) {
  const std::string what = fields.at("what");
  const std::string recording = fields.value("recording", "");
  for (const std::string& name : {what, recording})
    if (!name.empty() && !is_upload_name(name)) throw InputError(name + ": no such upload");
  const auto uploaded = [&](const std::string& name) {
    if (name.empty()) return fs::path();
    const fs::path file = uploads() / name;
    if (!fs::is_regular_file(file)) throw InputError(name + ": no such upload");
    if (!is_zip(file)) return file;
    tell("unpacking the recording");
    return unpacked_recording(file, uploads());
  };
  if (what == "embedded") {
    write_smile();
    open_text(embedded_scene(), options_.folder / "scene.toml");
  } else if (what == "started" && !options_.started.empty()) {
    const fs::path& file = options_.started;
    if (file.extension() == ".toml")
      open_text(read_file(file), file);
    else
      open_text(scan_scene(file, uploaded(recording)), options_.folder / "scene.toml");
  } else if (what == "autosave" && !options_.rescued.empty()) {
    const fs::path file = options_.rescued / "scene.toml";
    open_text(read_file(file), file);
    saved_ = false;
    send_scene();
  } else if (const fs::path file = uploaded(what); file.extension() == ".toml") {
    static_cast<void>(uploaded(recording));  // which the scene names
    open_text(with_uploads(read_file(file), uploads()), file);
  } else {
    open_text(scan_scene(file, uploaded(recording)), options_.folder / "scene.toml");
  }
  return json::object();
}

/// A scene of a scan, moved by a recording or, without one, by the smile that the program carries.
std::string Session::scan_scene(const fs::path& scan, const fs::path& recording) {
  std::string text = scene::with_value("", "scan.file", fs::absolute(scan).string());
  if (recording.empty()) {
    write_smile();
    text = scene::with_value(text, "motion.arkit", "smile_arkit.csv");
    return scene::with_value(text, "drive.by", "muscles");
  }
  return scene::with_value(text, scene::recording_key(recording), fs::absolute(recording).string());
}

void Session::write_smile() const {
  write_file_atomically(options_.folder / "smile_arkit.csv",
                        [](std::ostream& out) { out << embedded_smile(); });
}

void Session::make_face(const std::string& text, const fs::path& file) {
  auto made = std::make_unique<OpenFace>(text, file, options_.kept,
                                         [this](const std::string& stage) { tell(stage); });
  end_live();
  // The same skin on other tissue: the page only hears how it moves.
  const bool same_skin = face_ && face_->same_skin(*made);
  face_ = std::move(made);
  if (!same_skin) {
    scan_.reset();
    moved_.clear();
    face_sent_ = false;
  }
  variant_due_ = true;  // not again after each change of base, which more of them follow
  for (const std::string& warning : face_->warnings()) say("warning", warning);
}

void Session::open_text(const std::string& text, const fs::path& file) {
  make_face(text, file);
  now_ = {text, file};
  undo_.clear();
  redo_.clear();
  motion_due_ = true;
  saved_ = true;
  send_scene();
}

void Session::apply(const std::string& text) {
  if (need_face().set_text(text))
    refresh_live();
  else
    make_face(text, face_->file());
}

void Session::commit(const std::string& text) {
  apply(text);
  motion_due_ = true;
  if (text == now_.text) return;
  undo_.push_back(now_);
  if (undo_.size() > kMostSteps) undo_.erase(undo_.begin());
  redo_.clear();
  now_.text = text;
  saved_ = false;
  keep();
  send_scene();
}

std::string Session::changed(const json& wanted, int face) {
  if (!wanted.is_object()) throw InputError("changes: expected keys and values");
  std::string text = now_.text;
  json changes = json::object();
  need_face();
  const scene::Scene committed = scene::read_scene_text(now_.text, now_.file);
  const std::vector<std::string> known = known_paths();
  for (const auto& [key, value] : wanted.items()) {
    if (!scene::find_key(key)) throw InputError(key + ": no key of a scene");
    changes[key] = with_uploads(key, value, uploads(), known);
  }
  if (changes_muscles(changes) &&
      session::drive_choice(committed, face_->inputs()).by != simulate::DriveBy::muscles)
    text = scene::with_value(text, "drive.by", "muscles");
  if (face == 0) {
    for (const auto& [key, value] : changes.items()) text = scene::with_value(text, key, value);
    return text;
  }
  std::vector<json> blocks = scene::variant_blocks(text);
  if (std::size_t(face) > blocks.size())
    throw InputError(fmt::format("face {}: there are {}", face, blocks.size() + 1));
  json& block = blocks[std::size_t(face) - 1];
  for (const auto& [key, value] : changes.items()) {
    const std::string section = scene::section_of(key);
    const std::string name = section.empty() ? key : key.substr(section.size() + 1);
    json& table = section.empty() ? block : block[section];
    if (value.is_null() && table.is_object())
      table.erase(name);
    else if (!value.is_null())
      table[name] = value;
    if (!section.empty() && table.empty()) block.erase(section);
  }
  // A variant that changes nothing yet: what it will change is to come.
  if (block.size() == 1) block["motion"]["gain"] = values_of(committed)["motion.gain"];
  return scene::with_variants(text, blocks);
}

json Session::set(const json& fields) {
  const int face = fields.at("face");
  const std::string text = changed(fields.at("changes"), face);
  const bool following = live_ && !live_->ended();
  if (following) live_face_ = std::size_t(face);
  if (!fields.at("live").get<bool>()) {
    commit(text);
    return {{"superseded", false}};
  }
  if (!need_face().set_text(text)) return {{"superseded", false}};  // not while one drags
  if (following) {
    refresh_live();
    return {{"superseded", false}};
  }
  send_shape(std::size_t(face), fields.at("time_s"));
  return {{"superseded", false}};
}

json Session::undo_or_redo(std::vector<Step>& from, std::vector<Step>& to) {
  if (from.empty()) return json::object();
  const Step step = from.back();
  apply(step.text);
  from.pop_back();
  to.push_back(now_);
  now_ = step;
  motion_due_ = true;
  saved_ = false;
  keep();
  send_scene();
  return json::object();
}

json Session::save(const json& fields) {
  need_face();
  const std::string what = fields.at("what"), name = fields.at("name");
  check_save_name(name);
  const auto free = [&](const fs::path& path) {
    if (is_anothers(path))
      throw InputError(path,
                       "is there already, and the studio did not write it: expected another "
                       "name");
    return path;
  };
  const auto done = [&](const fs::path& path) {
    written_.push_back(path);
    return json{{"path", path}};
  };
  const fs::path into = options_.save_into;
  if (what == "scene") {
    const fs::path file = free(into / (name + ".toml"));
    const fs::path files = free(into / (name + "_files"));
    save_scene(now_.text, now_.file, {options_.folder, options_.rescued}, file);
    written_.push_back(files);
    keeps_rescued_ = keeps_rescued_ && now_.file.parent_path() != options_.rescued;
    saved_ = true;
    send_scene();
    return done(file);
  }
  if (what == "landmarks" || what == "landmarks_json") {
    const fs::path file = free(into / (name + (what == "landmarks" ? ".mrk.json" : ".json")));
    io::write_landmarks(file, face_->inputs().landmarks, face_->inputs().scan.unit);
    return done(file);
  }
  scene::Scene scene = scene::read_scene_text(now_.text, now_.file);
  scene.kept = options_.kept;
  tell(what == "run" ? "running and writing" : "running for the report");
  if (what == "run") {
    const fs::path folder = free(into / name);
    run::run_scene(scene, folder);
    tell("");
    return done(folder);
  }
  const fs::path file = free(into / (name + ".html"));
  scene.output.vtu = scene.output.glb = false;
  const fs::path folder = options_.folder / "report";
  run::run_scene(scene, folder);
  write_file_atomically(file, [&](std::ostream& out) { out << read_file(folder / "report.html"); });
  tell("");
  return done(file);
}

bool Session::has_work() const {
  // A live face needs the processors itself.
  const bool following = live_ && !live_->ended();
  return face_ &&
         (motion_due_ || ((variant_due_ || bands_due_) && !following && face_->up_to_date()));
}

void Session::work(const std::function<bool()>& cancelled) {
  Stopwatch watch;
  if (!motion_due_) return variant_due_ ? expect_variant() : find_bands(cancelled);
  simulate::RunCallbacks callbacks;
  callbacks.cancelled = cancelled;
  callbacks.progress = [&](double share) { tell("simulating", share); };
  try {
    face_->run(callbacks);
    motion_due_ = false;
    bands_due_ = options_.bands && !face_->bands_known();
    send_motion(watch);
  } catch (const simulate::Cancelled&) {
    return;
  } catch (const std::exception& error) {
    motion_due_ = false;
    say("error", without_folder(error.what(), options_.folder));
  }
  tell("");
}

/// Not broken off by a request: most likely that needs it.
void Session::expect_variant() {
  variant_due_ = false;
  try {
    face_->expect_variant();
  } catch (const std::exception&) {
    // Who makes a variant hears why there can be none.
  }
}

/// Without a word of what is done: nobody waits for it.
void Session::find_bands(const std::function<bool()>& cancelled) {
  Stopwatch watch;
  try {
    face_->find_bands(cancelled);
    bands_due_ = false;
    send_motion(watch);
  } catch (const simulate::Cancelled&) {
  } catch (const std::exception& error) {
    bands_due_ = false;
    say("warning",
        fmt::format("no error bands: {}", without_folder(error.what(), options_.folder)));
  }
}

void Session::send_motion(Stopwatch& watch) {
  report::BinaryBlock block;
  json head = {{"event", face_sent_ ? "motion" : "face"}};
  head["replay"] = face_->replay(block, !face_sent_);
  head["activations"] = face_->activations(block);
  if (face_sent_) {
    head["table"] = head["replay"]["summary"].contains("variants")
                        ? head["replay"]["summary"]["variants"]["table"]
                        : json::array();
    head["seconds"] = watch.lap();
    head["bands"] = face_->bands_known();
  } else {
    json landmarks = json::array();
    const std::vector<std::string>& placed = face_->inputs().placed;
    const fs::path& given = face_->scene().scan.landmarks;
    for (const auto& [name, place] : face_->inputs().landmarks)
      landmarks.push_back(
          {{"name", name},
           {"other", face::mirrored_landmark(name)},
           {"position", {place.x(), place.y(), place.z()}},
           {"found", given.empty() || std::count(placed.begin(), placed.end(), name) > 0}});
    head["landmarks"] = landmarks;
    head["muscles"] = muscles_json(face_->scene().muscles.table());
    const Eigen::VectorXf thickness = face_->unpainted_mm();
    head["thickness"] = block.add("float32", thickness.data(), std::size_t(thickness.size()));
  }
  send_(binary_message(head, block), true, "");
  face_sent_ = true;
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
                      {"drive", values[0]["drive.by"]},
                      {"drive_why", face_->drive_why()},
                      {"can_undo", !undo_.empty()},
                      {"can_redo", !redo_.empty()},
                      {"saved", saved_},
                      {"text", now_.text}};
  send_(event.dump(-1, ' ', false, json::error_handler_t::replace), false, "scene");
}

void Session::send_shape(std::size_t face, double time_s) {
  Stopwatch watch;
  if (face >= face_->faces()) throw InputError("face: there is none of this number");
  const bool first = !face_->ready(face);
  if (first) tell("finding the forces that move the face");
  const PointsF shape = face_->still(face, time_s);
  if (first) tell("");
  report::BinaryBlock block;
  json head = {{"event", "shape"}, {"face", face}, {"time_s", time_s}};
  add_shape(shape, block, head);
  head["seconds"] = watch.lap();
  send_(binary_message(head, block), true, fmt::format("shape-{}", face));
}

void Session::tell(const std::string& stage, double share) {
  const json event = {{"event", "progress"}, {"stage", stage}, {"share", share}};
  send_(event.dump(), false, "progress");
}

void Session::say(const char* level, const std::string& text) {
  const json event = {{"event", "said"}, {"level", level}, {"text", text}};
  send_(event.dump(-1, ' ', false, json::error_handler_t::replace), false, "");
}

void Session::keep() {
  try {
    save_scene(now_.text, now_.file, {}, options_.folder / "scene.toml");
  } catch (const std::exception& error) {
    say("warning",
        fmt::format("what is not saved would be lost with the studio: {}", error.what()));
  }
}

}  // namespace hyperex::studio
