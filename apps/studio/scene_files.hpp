// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Built-in scenes, and the files that a scene names when it moves to another folder.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::studio {

/// A scene of the embedded face, moved by its muscles. It names "smile_arkit.csv" in the same
/// folder.
std::string embedded_scene();
/// The contents of "smile_arkit.csv".
std::string_view embedded_smile();

/// The scene `text`, which names no motion yet, moved by a recording. Where a recording of points
/// shows points that are still as those of the skull are, the scene names them
/// (session::points_to_hold_the_head). Throws InputError where such a recording cannot be read.
std::string moved_by(const std::string& text, const std::filesystem::path& recording);
/// The scene moved by another recording. Options of the previous recording are removed; the face
/// and all other options stay.
std::string with_recording(const std::string& text, const std::filesystem::path& recording);

/// Replaces each path in the value of a key, also in rows of tables, by the file of the same name
/// in `uploads`, so that no path sent by a page reaches the file system. "embedded" and paths in
/// `known` stay. Throws InputError for a name that is not in `uploads`.
nlohmann::json with_uploads(const std::string& key, nlohmann::json value,
                            const std::filesystem::path& uploads,
                            const std::vector<std::string>& known);
/// The same for all paths of an uploaded scene.
std::string with_uploads(const std::string& text, const std::filesystem::path& uploads);
/// Unpacks a zip with a recording (a folder with rgb.txt) into `uploads` and removes the zip.
/// Returns the folder, named as in the zip, or after the zip where its files are in no folder.
/// Throws InputError.
std::filesystem::path unpacked_recording(const std::filesystem::path& zip,
                                         const std::filesystem::path& uploads);
/// Every path in a scene's values (options_json()).
std::vector<std::string> paths_of(const nlohmann::json& options);

/// Writes the text of the scene file `from` to `to`. Relative paths are adapted; files inside one
/// of the folders `copied` are copied into a folder beside `to`. Throws InputError where writing
/// fails.
void save_scene(const std::string& text, const std::filesystem::path& from,
                const std::vector<std::filesystem::path>& copied, const std::filesystem::path& to);

}  // namespace hyperex::studio
