// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scenes that the studio makes, and the files that a scene names when it moves to another folder.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::studio {

/// The face that comes with the program, with a smile that its muscles make; names
/// "smile_arkit.csv" beside it.
std::string embedded_scene();
/// That file.
std::string_view embedded_smile();

/// No path of a page reaches the file system: where `value` of the key holds paths (those in rows
/// of tables too) each becomes that of the file of this name in `uploads`; "embedded" and those in
/// `known` stay. Throws InputError for any other.
nlohmann::json with_uploads(const std::string& key, nlohmann::json value,
                            const std::filesystem::path& uploads,
                            const std::vector<std::string>& known);
/// The same for all that a scene that was uploaded names.
std::string with_uploads(const std::string& text, const std::filesystem::path& uploads);
/// Unpacks a zip with a recording's folder (rgb.txt in it) into `uploads` and removes the zip: that
/// folder, by its own name or, where the files lie bare in it, the zip's. Throws InputError.
std::filesystem::path unpacked_recording(const std::filesystem::path& zip,
                                         const std::filesystem::path& uploads);
/// Every path that a scene's values hold (options_json()).
std::vector<std::string> paths_of(const nlohmann::json& options);

/// Writes the scene `text`, which stands in `from`, to `to`. Files that it names are named from
/// there; those that lie in one of `copied` (folders) are copied into a folder beside it.
/// Throws InputError where that cannot be written.
void save_scene(const std::string& text, const std::filesystem::path& from,
                const std::vector<std::filesystem::path>& copied, const std::filesystem::path& to);

}  // namespace hyperex::studio
