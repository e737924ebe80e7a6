// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Makes a first scene from a scan and a recording.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperex::scene {

/// The key that a recording belongs to, from its extension and, for a CSV, its columns:
/// "motion.arkit", "motion.openface", "motion.file" (points over time: .csv, .trc) or
/// "motion.recording" (all others: folders of pictures, videos, recordings of depth cameras).
/// Throws InputError for a CSV that cannot be read.
std::string recording_key(const std::filesystem::path& recording);

/// The kind of a file from its extension: "scan", "recording", or empty for all others.
std::string other_kind(const std::filesystem::path& file);

struct NewScene {
  /// Paths as written in the scene; "embedded": the program's own data.
  std::string scan, motion;
  std::string motion_key;                 ///< recording_key(), or "motion.file" for "embedded"
  std::string unit;                       ///< of the scan: "mm", "cm", "m"; empty: as the file says
  std::string unit_note;                  ///< how the unit was found, for a comment
  std::vector<std::string> rigid_points;  ///< found in the recording; empty: none to be written
  std::string name;   ///< of the scene's file without its extension; for the title and commands
  int vtu_every = 1;  ///< output.vtu_every of a long recording; 1: not written
  double long_s = 0;  ///< how long a long recording lasts, for a comment on its parts; 0: none
};

/// A part of a recording, as time.start_s and time.end_s of a scene name it.
struct PartOfRecording {
  double start_s = 0, end_s = 0;  ///< where it begins in the recording; how long it lasts
};

/// What a first look at a long recording may show: 6 s from its middle on. Nothing where the whole
/// recording lasts less than twice as long.
std::optional<PartOfRecording> part_to_run(double recording_s);

/// The text of the scene, with comments that say what to change next. It has one variant, so that a
/// first run compares two cases. `name` and paths may contain any character.
std::string new_scene_text(const NewScene& of);

}  // namespace hyperex::scene
