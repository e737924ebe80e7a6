// SPDX-License-Identifier: GPL-3.0-or-later
// Opening scans, recordings and scenes.

#include <fmt/format.h>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/scene/new_scene.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "scene_files.hpp"
#include "session.hpp"
#include "upload_name.hpp"

namespace hyperex::studio {

json Session::open(const json& fields) {
  const std::string what = fields.at("what");
  const std::string recording = fields.value("recording", "");
  for (const std::string& name : {what, recording})
    if (!name.empty() && !is_upload_name(name)) throw InputError(name + ": no such upload");
  const auto uploaded = [&](const std::string& name) {
    if (name.empty()) return fs::path();
    const fs::path file = uploads() / name;
    if (!fs::is_regular_file(file)) throw InputError(name + ": no such upload");
    if (ending_of(file) != ".zip" || name == what) return file;
    report_progress("unpacking the recording");
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
  } else if (what == "current") {
    const fs::path file = uploaded(recording);
    if (file.empty()) throw InputError("recording: expected the name of an upload");
    require_face();
    const Step before = now_;
    commit(with_recording(now_.text, file));
    earlier_ = before;
    if (const std::string earlier = earlier_recording(); !earlier.empty())
      log("note", fmt::format("the recording before, {}, can be compared with this one as an "
                              "earlier visit of the same person (Files: What has changed?)",
                              earlier));
    send_scene();
  } else if (const fs::path file = uploaded(what); file.extension() == ".toml") {
    static_cast<void>(uploaded(recording));  // unpacks it; the scene names it by itself
    open_text(with_uploads(read_file(file), uploads()), file);
  } else if (is_ct(file)) {
    // A CT names the patient; this copy is not needed once it is read.
    struct Removed {
      const fs::path& file;
      ~Removed() {
        std::error_code ignored;
        fs::remove(file, ignored);
      }
    } const removed{file};
    open_ct(file, uploaded(recording));
  } else {
    open_text(scan_scene(file, uploaded(recording)), options_.folder / "scene.toml");
  }
  return json::object();
}

std::string Session::scan_scene(const fs::path& scan, const fs::path& recording) {
  std::string text = scene::with_value("", "scan.file", fs::absolute(scan).string());
  if (recording.empty()) {
    write_smile();
    text = scene::with_value(text, "motion.arkit", "smile_arkit.csv");
    return scene::with_value(text, "drive.by", "muscles");
  }
  return moved_by(text, recording);
}

void Session::write_smile() const {
  write_file_atomically(options_.folder / "smile_arkit.csv",
                        [](std::ostream& out) { out << embedded_smile(); });
}

void Session::make_face(const std::string& text, const fs::path& file,
                        std::vector<scene::LeftOutVariant>* left_out) {
  auto made = std::make_unique<OpenFace>(
      text, file, options_.kept, [this](const std::string& stage) { report_progress(stage); },
      left_out);
  end_live();
  // The same skin on other tissue: the page needs only the motion.
  const bool same_skin = face_ && face_->same_skin(*made);
  face_ = std::move(made);
  if (!same_skin) {
    scan_.reset();
    moved_.clear();
    face_sent_ = false;
  }
  // Only here: recomputing it after each change of base would often be wasted.
  variant_due_ = true;
  budget_due_ = false;
  for (const Note& note : face_->session().warnings()) log("warning", note.text);
}

void Session::open_text(const std::string& text, const fs::path& file) {
  std::vector<scene::LeftOutVariant> left_out;
  make_face(text, file, has_tables_of_variants(text) ? &left_out : nullptr);
  left_out_ = left_out_of(text, left_out);
  for (const Note& note : left_out_.notes) log("warning", note.text);
  ct_.reset();
  now_ = {face_->text(), file};
  undo_.clear();
  redo_.clear();
  earlier_.reset();
  motion_due_ = true;
  saved_ = true;
  send_scene();
}

}  // namespace hyperex::studio
