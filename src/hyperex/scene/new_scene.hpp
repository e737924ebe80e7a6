// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A scene to begin with, made of a scan and a recording.
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex::scene {

/// The key that a recording belongs to, told by its ending and, of a CSV, by its columns:
/// "motion.arkit", "motion.openface", "motion.file" (points over time: .csv, .trc) or
/// "motion.recording" (all else: folders of pictures, videos, recordings of depth cameras).
/// Throws InputError for a CSV that cannot be read.
std::string recording_key(const std::filesystem::path& recording);

/// What a file is by the ending of its name: "scan", "recording", or empty for all else.
std::string other_kind(const std::filesystem::path& file);

struct NewScene {
  /// Paths as the scene shall name them; "embedded": the program's own.
  std::string scan, motion;
  std::string motion_key;                 ///< recording_key(), or "motion.file" for "embedded"
  std::string unit;                       ///< of the scan: "mm", "cm", "m"; empty: the file says it
  std::string unit_note;                  ///< how the unit was found, for a comment
  std::vector<std::string> rigid_points;  ///< found in the recording; empty: none to be named
  std::string name;  ///< of the scene's file without its ending, for title and commands
};

/// The scene as text, with comments that tell what to change next. It has one variant, so that a
/// run answers a question. `name` and paths may hold any character.
std::string new_scene_text(const NewScene& of);

}  // namespace hyperex::scene
