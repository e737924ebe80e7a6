// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scenes that the studio makes, and the files that a scene names when it moves to another folder.
#include <filesystem>
#include <string>
#include <string_view>

namespace hyperex::studio {

/// The face that comes with the program, with a smile that its muscles make; names
/// "smile_arkit.csv" beside it.
std::string embedded_scene();
/// That file.
std::string_view embedded_smile();

/// The key of a scene that a recording of this name belongs to: "motion.file", "motion.recording".
std::string recording_key(const std::filesystem::path& recording);

/// Writes the scene `text`, which stands in `from`, to `to`. Files that it names are named from
/// there; those that lie in `copied` (a folder; empty: none) are copied into a folder beside it.
/// Throws InputError where that cannot be written.
void save_scene(const std::string& text, const std::filesystem::path& from,
                const std::filesystem::path& copied, const std::filesystem::path& to);

}  // namespace hyperex::studio
