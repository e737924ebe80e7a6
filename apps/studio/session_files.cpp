// SPDX-License-Identifier: GPL-3.0-or-later
// Files in the folder that the user saves to, the autosaved scene, and what a crashed session left.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/run/run_scene.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "scene_files.hpp"
#include "session.hpp"
#include "upload_name.hpp"

namespace hyperex::studio {

void Session::check_save_name(const std::string& name) {
  if (!is_upload_name(name))
    throw InputError("name: expected letters, digits, spaces and any of -_.(), the first no dot");
}

bool Session::is_foreign(const fs::path& path) const {
  // The studio writes no links, so that somebody else must have put one there.
  if (fs::is_symlink(fs::symlink_status(path))) return true;
  return fs::exists(fs::symlink_status(path)) &&
         std::find(written_.begin(), written_.end(), path) == written_.end();
}

json Session::free_name(const json& fields) {
  // All endings that save() may write.
  constexpr std::array endings = {"", ".toml", "_files", ".html", ".mrk.json", ".json"};
  const std::string wanted = fields.at("name");
  check_save_name(wanted);
  for (int n = 1;; ++n) {
    const std::string name = n == 1 ? wanted : wanted + "-" + std::to_string(n);
    if (std::none_of(endings.begin(), endings.end(), [&](const char* ending) {
          return is_foreign(options_.save_into / (name + ending));
        }))
      return {{"name", name}};
  }
}

json Session::discard_autosave(const json&) {
  if (options_.rescued.empty()) throw InputError("no crashed session has left work");
  if (face_ && now_.file.parent_path() == options_.rescued)
    throw InputError("the recovered work is open: save it, or open something else first");
  std::error_code error;
  fs::remove_all(options_.rescued, error);
  if (error) throw InputError("the recovered work cannot be deleted (" + error.message() + ")");
  options_.rescued.clear();
  keeps_rescued_ = false;
  return json::object();
}

fs::path Session::require_own(const fs::path& path) const {
  if (is_foreign(path))
    throw InputError(path,
                     "is there already, and the studio did not write it: expected another name");
  return path;
}

json Session::save(const json& fields) {
  require_face();
  const std::string what = fields.at("what"), name = fields.at("name");
  check_save_name(name);
  const auto with_ending = [&](const char* ending) {
    return require_own(options_.save_into / (name + ending));
  };
  fs::path path;
  if (what == "scene") {
    path = save_scene_file(name);
  } else if (what == "run") {
    path = save_run(with_ending(""));
  } else if (what == "report") {
    path = save_report(with_ending(".html"));
  } else {
    path = with_ending(what == "landmarks" ? ".mrk.json" : ".json");
    io::write_landmarks(path, face_->inputs().landmarks, face_->inputs().scan.unit);
  }
  written_.push_back(path);
  if (what != "landmarks") report_left_out(what == "scene");
  return {{"path", path}};
}

fs::path Session::save_scene_file(const std::string& name) {
  const fs::path file = require_own(options_.save_into / (name + ".toml"));
  const fs::path files = require_own(options_.save_into / (name + "_files"));
  save_scene(text_to_save(), now_.file, {options_.folder, options_.rescued}, file);
  written_.push_back(files);
  keeps_rescued_ = keeps_rescued_ && now_.file.parent_path() != options_.rescued;
  saved_ = true;
  send_scene();
  return file;
}

fs::path Session::save_run(const fs::path& folder) {
  scene::Scene scene = scene::read_scene_text(now_.text, now_.file);
  scene.kept = options_.kept;
  report_progress("running and writing");
  run::run_scene(scene, folder, options_.ending);
  report_progress("");
  return folder;
}

fs::path Session::save_report(const fs::path& file) {
  scene::Scene scene = scene::read_scene_text(now_.text, now_.file);
  scene.kept = options_.kept;
  scene.output.vtu = scene.output.glb = false;
  report_progress("running for the report");
  const fs::path folder = options_.folder / "report";
  run::run_scene(scene, folder, options_.ending);
  write_file_atomically(file, [&](std::ostream& out) { out << read_file(folder / "report.html"); });
  report_progress("");
  return file;
}

void Session::autosave() {
  try {
    save_scene(text_to_save(), now_.file, {}, options_.folder / "scene.toml");
  } catch (const std::exception& error) {
    log("warning",
        fmt::format("the work is not autosaved, so a crash would lose it: {}", error.what()));
  }
}

}  // namespace hyperex::studio
