// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/new_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/io/csv_cells.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/scene/toml_values.hpp"

namespace hyperex::scene {
namespace {

/// The path quoted as one word of a command line.
std::string quoted(const std::string& path) {
  std::string out = "'";
  for (const char c : path) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  out += '\'';
  const bool plain = path.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./") ==
                     std::string::npos;
  return plain ? path : out;
}

/// Replaces line breaks, since a comment ends with its line.
std::string in_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

/// The line that names the columns: comments and empty lines may come before it.
std::string_view names_line(std::string_view table) {
  io::Lines lines(table);
  std::string_view line;
  while (lines.next(line))
    if (const std::string_view text = io::trimmed(line); !text.empty() && text.front() != '#')
      return line;
  return {};
}

/// Whether a column of a table is a blend shape's, as of a blink alone. Live Link writes them with
/// a capital letter.
bool names_a_blend_shape(const std::string& table) {
  const std::string_view names = names_line(table);
  return std::ranges::any_of(
      io::cells_of(names, io::separator_of(names)), [](const std::string& column) {
        return std::ranges::any_of(expression::arkit_shapes(), [&](const std::string& shape) {
          return lower_case(column) == lower_case(shape);
        });
      });
}

/// How to run a part, and fewer frames for ParaView; empty where the recording is short.
std::string of_a_long_recording(const NewScene& of) {
  std::string out;
  if (const auto part = part_to_run(of.long_s))
    out += fmt::format(
        "\n# The recording lasts {:.4g} s. To run a part of it:\n"
        "# [time]\n"
        "# start_s = {:.4g}  # where the run begins in the recording\n"
        "# end_s = {:.4g}         # how long the run lasts\n",
        of.long_s, part->start_s, part->end_s);
  if (of.vtu_every > 1)
    out += fmt::format(
        "\n[output]\n"
        "# The recording is long: all frames for ParaView would take more than output.most_gb.\n"
        "vtu_every = {}  # one frame of this many is written\n",
        of.vtu_every);
  return out;
}

}  // namespace

std::optional<PartOfRecording> part_to_run(double recording_s) {
  constexpr double part_s = 6;
  if (recording_s < 2 * part_s) return std::nullopt;
  return PartOfRecording{std::round(recording_s / 2), part_s};
}

std::string recording_key(const std::filesystem::path& recording) {
  const std::string ending = ending_of(recording);
  if (ending == ".trc") return "motion.file";
  if (ending != ".csv") return "motion.recording";
  const std::string head = read_file(recording).substr(0, 65536);
  if (names_a_blend_shape(head)) return "motion.arkit";
  if (head.find("AU12_r") != std::string::npos) return "motion.openface";
  return "motion.file";
}

std::string other_kind(const std::filesystem::path& file) {
  const std::string extension = ending_of(file);
  for (const char* scan : {".ply", ".obj", ".stl", ".gltf", ".glb"})
    if (extension == scan) return "scan";
  for (const char* recording : {".csv", ".trc", ".mp4", ".mov", ".avi", ".oni"})
    if (extension == recording) return "recording";
  return "";
}

std::string new_scene_text(const NewScene& of) {
  const std::string file = quoted(in_one_line(of.name) + ".toml");
  std::string out = fmt::format(
      "# A scene for Hyperex. docs/scene.md lists every key with its default and unit.\n"
      "#   hyperex check {0}\n"
      "#       what is wrong or doubtful, before anything is simulated\n"
      "#   hyperex run {0} --out {1}\n"
      "#       figures, pictures and report.html, to open in a browser\n"
      "#   hyperex studio {0}\n"
      "#       the same face in the browser, with sliders\n"
      "title = {2}\n\n"
      "[scan]\n"
      "file = {3}\n",
      file, quoted("out/" + in_one_line(of.name)), toml_text(of.name), toml_text(of.scan));
  if (!of.unit.empty())
    out += fmt::format("unit = {}  # {}\n", toml_text(of.unit), in_one_line(of.unit_note));
  if (of.scan != "embedded")
    out += fmt::format(
        "# Landmarks are found on the scan. To look at them and to correct them:\n"
        "#   hyperex landmarks {} --out landmarks.json\n"
        "# landmarks = \"landmarks.json\"\n",
        quoted(in_one_line(of.scan)));
  out += fmt::format("\n[motion]\n{} = {}\n", of.motion_key.substr(of.motion_key.find('.') + 1),
                     toml_text(of.motion));
  if (of.motion_key == "motion.file" && of.motion != "embedded")
    out += "# The first sample is taken for the face at rest.\n";
  if (!of.rigid_points.empty()) {
    out +=
        "# These keep still against each other, as points of the skull do.\nrigid_points = "
        "[";
    for (std::size_t i = 0; i < of.rigid_points.size(); ++i)
      out += (i > 0 ? ", " : "") + toml_text(of.rigid_points[i]);
    out += "]\n";
  }
  if (of.motion_key == "motion.recording")
    out +=
        "# The face is tracked first; its first frames are taken for the face at rest.\n"
        "# mirrored = true  # where the pictures show the world as a mirror does\n";
  out += of_a_long_recording(of);
  out +=
      "\n[tissue]\n"
      "# young_kpa = 100          # the stiffness of all tissue (Young's modulus)\n"
      "# preset = \"aged_skin\"     # or from the literature: hyperex presets\n"
      "\n# What if? The same muscle forces act in each variant of the scene.\n"
      "[[variant]]\n"
      "name = \"weak right zygomatic branch\"\n"
      "muscles.gain = { zygomatic_R = 0.3 }  # 30 % of its strength; one muscle: zyg_major_R\n"
      "\n# [[variant]]\n"
      "# name = \"stiff right cheek\"\n"
      "# tissue.region = [{ name = \"cheek_R\", young_factor = 5 }]\n"
      "\n# [[variant]]\n"
      "# preset = \"palsy_complete_R\"  # hyperex presets lists others\n";
  return out;
}

}  // namespace hyperex::scene
