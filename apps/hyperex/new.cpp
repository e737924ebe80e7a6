// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "hyperex/capture/open_source.hpp"
#include "hyperex/capture/still.hpp"
#include "hyperex/capture/tum_folder.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/still_points.hpp"
#include "hyperex/motion/try_stabilise.hpp"
#include "hyperex/scene/new_scene.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/check_alone.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/recording_names.hpp"
#include "hyperex/session/run_cost.hpp"

namespace hyperex::cli {
namespace {

namespace fs = std::filesystem;

/// The path relative to the scene's folder, if that is shorter.
std::string seen_from(const fs::path& folder, const std::string& path) {
  if (path == "embedded") return path;
  const fs::path whole = fs::absolute(path).lexically_normal();
  const std::string near = whole.lexically_proximate(folder.lexically_normal()).generic_string();
  return near.starts_with("../../..") ? whole.generic_string() : near;
}

/// A scene is a TOML file, and TOML allows UTF-8 only.
void refuse_other_encoding(const std::string& name) {
  if (!is_utf8(name))
    throw InputError(printable(name) +
                     ": the name is not in UTF-8, and a scene cannot hold it; expected a file of "
                     "another name");
}

/// Refuses files that cannot be read as a recording, and a scan and a recording given in each
/// other's place.
void refuse_no_recording(const std::string& scan, const std::string& motion) {
  const std::string kind = motion == "embedded" ? "" : scene::other_kind(motion);
  if (kind == "scan" && scene::other_kind(scan) == "recording")
    throw InputError(fmt::format(
        "{0} is a recording and {1} a scan: the scan comes first, then the recording; expected "
        "hyperex new {1} {0}",
        scan, motion));
  if (kind == "scan")
    throw InputError(motion,
                     "is a scan; expected a recording: the scan comes first, then the "
                     "recording");
  if (motion == "embedded" || fs::is_directory(motion)) return;
  if (capture::is_picture(motion))
    throw InputError(motion,
                     "is one picture, which has no motion; expected a video, a depth camera's "
                     "recording, a CSV or a TRC");
  if (kind == "recording") {
    // throws where not even the first frame can be read
    if (scene::recording_key(motion) == "motion.recording") capture::open_source(motion);
    return;
  }
  // throws, naming the format to export to.
  if (ending_of(motion) == ".c3d") motion::read_motion(motion);
  try {  // perhaps a video with another extension
    capture::open_source(motion);
  } catch (const InputError& error) {
    throw InputError(motion,
                     fmt::format("is no recording that can be read; expected a CSV, a TRC, a "
                                 "video, an .oni file or a folder with a depth camera's pictures "
                                 "(as a video: {})",
                                 error.what()));
  }
}

/// What a run of the new scene takes; nothing where hyperex check will say why that is not known.
std::optional<session::RunCost> cost_of(const scene::Scene& scene) {
  try {
    return session::cost_before_tracking(scene);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Writes fewer frames of a long recording, so that the run stays within its bound, and says how to
/// run a part of it. Returns the cost of a run that takes minutes, if the recording has two parts
/// of 6 s.
std::optional<session::RunCost> suit_long_recording(scene::NewScene& made, const fs::path& to) {
  constexpr double long_s = 60, two_parts_s = 12;
  const auto scene = [&] { return scene::read_scene_text(scene::new_scene_text(made), to); };
  const scene::Scene whole = scene();  // throws before anything is written
  auto cost = cost_of(whole);
  if (!cost) return std::nullopt;
  made.vtu_every = session::vtu_every_within_bound(whole, *cost);
  if (cost->seconds < long_s || cost->to_s - cost->from_s < two_parts_s) return std::nullopt;
  made.long_s = cost->to_s - cost->from_s;
  return made.vtu_every > 1 ? cost_of(scene()) : cost;
}

/// The forecast of a run that takes minutes, and the command that runs a part of a long recording.
std::string words_on_a_long_run(const session::RunCost& whole, const std::string& to,
                                const std::string& name) {
  std::string words = session::sentence_of(whole) + "\n";
  if (const auto part = scene::part_to_run(whole.to_s - whole.from_s))
    words += fmt::format(
        "a part of it, {0:.4g} s from {1:.4g} s on: hyperex run {2} --out out/{3} --set "
        "time.start_s={1:.4g} --set time.end_s={0:.4g}\n",
        part->end_s, part->start_s, to, name);
  return words;
}

/// Refuses a table that is no motion. Returns a doubt about one that is very short.
std::optional<Note> doubt_of_length(const std::string& key, const std::string& file) {
  constexpr auto of_weights = session::Readings::of_weights;
  if (key == "motion.arkit")
    return session::short_warning(expression::read_arkit(file).time_s, of_weights);
  if (key == "motion.openface")
    return session::short_warning(expression::read_openface(file).time_s, of_weights);
  return std::nullopt;
}

/// What a check would say of the recording by itself: the scene is written all the same, so that it
/// can be corrected there or with the recording.
void add_doubts_of_sides(const motion::Motion& points, std::vector<std::string>& doubts) {
  try {
    for (const Note& doubt : session::check_alone(points)) doubts.push_back(doubt.text);
  } catch (const InputError& error) {
    doubts.emplace_back(error.what());
  }
}

void write_scene(const std::string& scan, const std::string& motion, fs::path to) {
  const auto refuse_missing = [](const char* what, const std::string& path) {
    if (path != "embedded" && !fs::exists(path))
      throw InputError(
          fmt::format("{}: there is no such file; expected {}, or embedded", path, what));
  };
  for (const std::string& name : {scan, motion, to.string()}) refuse_other_encoding(name);
  refuse_missing("a scan", scan);
  refuse_missing("a recording", motion);
  refuse_no_recording(scan, motion);
  // Throws if the folder is incomplete.
  if (fs::is_directory(motion)) capture::open_tum_folder(motion);
  scene::NewScene made;
  if (scan != "embedded") {
    const io::Scan read = io::read_scan(scan);
    made.unit = io::name_of(read.unit);
    made.unit_note = io::unit_note(read);
  }
  if (to.empty()) to = fs::path(scan).stem().string() + ".toml";
  if (fs::exists(to))
    throw InputError(to.string() + ": is there already; name another file by --out");
  made.name = to.stem().string();
  const fs::path folder = fs::absolute(to).parent_path();
  made.scan = seen_from(folder, scan);
  made.motion = seen_from(folder, motion);
  made.motion_key = motion == "embedded" ? "motion.file" : scene::recording_key(motion);
  std::vector<std::string> doubts;
  if (const auto doubt = doubt_of_length(made.motion_key, motion)) doubts.push_back(doubt->text);
  motion::StillPoints still;
  if (made.motion_key == "motion.file" && motion != "embedded") {
    const motion::Motion points = motion::read_motion(motion);
    if (points.time_s.size() < 2)
      throw InputError(motion, "has one sample, and nothing moves; expected two or more");
    if (const auto doubt = session::short_warning(points.time_s)) doubts.push_back(doubt->text);
    still = session::points_to_hold_the_head(points);
    made.rigid_points = still.names;
    for (std::string& doubt : session::doubts_of_names(points, made.rigid_points))
      doubts.push_back(std::move(doubt));
    add_doubts_of_sides(points, doubts);
  }
  const auto cost = suit_long_recording(made, to);
  const std::string text = scene::new_scene_text(made);
  write_file_atomically(to, [&](std::ostream& out) { out << text; });
  for (const std::string& doubt : doubts) spdlog::warn("{}", doubt);
  if (!still.names.empty())
    std::cout << motion::still_points_sentence(still) << " (motion.rigid_points)\n";
  std::cout << fmt::format(
      "written: {0}\nnext: hyperex check {0}\n      hyperex run {0} --out out/{1}\n{2}",
      printable(to.string()), printable(made.name),
      cost ? words_on_a_long_run(*cost, printable(to.string()), printable(made.name)) : "");
}

}  // namespace

void add_new(CLI::App& program) {
  struct NewOptions {
    std::string scan, motion;
    fs::path to;
  };
  auto options = std::make_shared<NewOptions>();
  CLI::App* command = program.add_subcommand(
      "new", "Write a first scene, with comments, for a scan and a recording");
  command
      ->add_option("SCAN", options->scan,
                   "PLY, OBJ, STL, glTF or GLB; or embedded, the face that comes with the program")
      ->required();
  command
      ->add_option("MOTION", options->motion,
                   "CSV of points, ARKit weights or OpenFace's units; TRC; a depth camera's "
                   "recording or a video; or embedded")
      ->required();
  command->add_option("--out", options->to,
                      "The scene's file, which must not exist [default: SCAN's name with .toml, in "
                      "the current folder]");
  command->footer("Example: hyperex new me.ply smile.csv --out me.toml");
  command->callback([options] { write_scene(options->scan, options->motion, options->to); });
}

}  // namespace hyperex::cli
