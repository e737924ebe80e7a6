// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "hyperex/capture/tum_folder.hpp"
#include "hyperex/core/carried_file.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/zip.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/new_scene.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/session/recording_names.hpp"
#include "upload_name.hpp"

namespace hyperex::studio {

using nlohmann::json;
namespace fs = std::filesystem;

HX_CARRIED_FILE(embedded_smile, HYPEREX_STUDIO_SMILE)

namespace {

/// Visits the paths in the value of a key, also in rows of tables.
void for_paths(const scene::KeyInfo& key, json& value, const std::function<void(json&)>& visit) {
  if (key.kind == scene::Kind::path && value.is_string() && value != "embedded") visit(value);
  if (key.kind != scene::Kind::rows || !value.is_array()) return;
  for (json& row : value)
    for (const scene::KeyInfo& column : key.columns)
      if (row.is_object() && row.contains(column.name)) for_paths(column, row[column.name], visit);
}

void for_paths_of_tables(json& tables, const std::function<void(json&)>& visit) {
  for (const scene::Key& key : scene::keys()) {
    const std::string section = scene::section_of(key.name);
    json* table = section.empty() ? &tables : tables.contains(section) ? &tables[section] : nullptr;
    if (!table || !table->is_object()) continue;
    const std::string name = section.empty() ? key.name : key.name.substr(section.size() + 1);
    if (table->contains(name)) for_paths(key, (*table)[name], visit);
  }
}

/// A scene's text with its paths changed by `visit`.
std::string with_paths(const std::string& text, const std::function<void(json&)>& visit) {
  json before;
  try {
    before = scene::parse_toml(text).root;
  } catch (const scene::TornToml&) {
    return text;  // reading the scene reports the error
  }
  json after = before;
  for_paths_of_tables(after, visit);
  std::string out = text;
  for (const auto& [section, table] : after.items()) {
    if (section == "variant" || table == before.at(section)) continue;
    if (!table.is_object()) {
      out = scene::with_value(out, section, table);
      continue;
    }
    for (const auto& [key, value] : table.items())
      if (value != before.at(section).at(key))
        out = scene::with_value(out, section + "." + key, value);
  }
  std::vector<json> blocks = scene::variant_blocks(text);
  for (json& block : blocks)
    if (block.is_object()) for_paths_of_tables(block, visit);
  if (blocks != scene::variant_blocks(text)) out = scene::with_variants(out, blocks);
  return out;
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  if (folder.empty()) return false;
  const fs::path way = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
  return !way.empty() && *way.begin() != "..";
}

}  // namespace

std::string embedded_scene() {
  return "# A smile of the face that comes with Hyperex, made by its muscles.\n"
         "title = \"A smile\"\n\n"
         "[scan]\nfile = \"embedded\"\n\n"
         "[motion]\narkit = \"smile_arkit.csv\"\n\n"
         "[drive]\nby = \"muscles\"\n";
}

std::string moved_by(const std::string& text, const fs::path& recording) {
  const std::string key = scene::recording_key(recording);
  const std::string moved = scene::with_value(text, key, fs::absolute(recording).string());
  if (key != "motion.file") return moved;
  const auto rigid = session::points_to_hold_the_head(motion::read_motion(recording)).names;
  return rigid.empty() ? moved : scene::with_value(moved, "motion.rigid_points", rigid);
}

std::string with_recording(const std::string& text, const fs::path& recording) {
  const json root = scene::parse_toml(text).root;
  std::string out = text;
  if (root.contains("motion") && root["motion"].is_object())
    for (const auto& [key, value] : root["motion"].items())
      if (key != "gain") out = scene::with_value(out, "motion." + key, nullptr);
  // The title belongs to the built-in smile and is removed with it.
  if (root.value("title", "") == scene::parse_toml(embedded_scene()).root["title"])
    out = scene::with_value(out, "title", nullptr);
  return moved_by(out, recording);
}

json with_uploads(const std::string& key, json value, const fs::path& uploads,
                  const std::vector<std::string>& known) {
  const scene::Key* info = scene::find_key(key);
  if (!info) return value;
  for_paths(*info, value, [&](json& path) {
    const std::string name = path.get<std::string>();
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    if (!is_upload_name(name) || !fs::is_regular_file(uploads / name))
      throw InputError(key + ": expected the name of a file that was uploaded");
    path = (uploads / name).string();
  });
  return value;
}

std::string with_uploads(const std::string& text, const fs::path& uploads) {
  const auto taken = [&](json& path) {
    // A saved scene names files in a folder beside it; uploads have no folders.
    const std::string name = fs::path(path.get<std::string>()).filename().string();
    if (!is_upload_name(name) || !fs::exists(uploads / name))
      throw InputError(
          fs::path(name).has_extension()
              ? fmt::format("the scene names {}: open that file together with it", name)
              : fmt::format("the scene names the folder {}: open it from the command line "
                            "(hyperex studio SCENE.toml)",
                            name));
    path = (uploads / name).string();
  };
  return with_paths(text, taken);
}

namespace {

/// The folder in a zip that holds a recording, by the zip's directory alone.
fs::path recording_in(const fs::path& zip, const io::UnzipLimits& limits) {
  constexpr int kDeepest = 3;  // of the folder
  const std::vector<fs::path> files = io::files_in_zip(zip, limits);
  const auto depth = [](const fs::path& path) { return std::distance(path.begin(), path.end()); };
  const fs::path* list = nullptr;
  for (const fs::path& file : files)
    if (file.filename() == "rgb.txt" && depth(file) <= kDeepest + 1 &&
        (!list || depth(file) < depth(*list)))
      list = &file;
  if (!list)
    throw InputError(zip.filename(),
                     "holds no recording: expected a folder with rgb.txt and its pictures");
  const fs::path folder = list->parent_path(), camera = folder / "camera.toml";
  if (std::find(files.begin(), files.end(), camera) == files.end())
    throw InputError(zip.filename() / camera,
                     "missing: expected the camera's file beside rgb.txt (docs/tracking.md)");
  return folder;
}

}  // namespace

fs::path unpacked_recording(const fs::path& zip, const fs::path& uploads) {
  constexpr std::uint64_t kMost = std::uint64_t(4) << 30U;  // bytes of all uploads, unpacked
  // Pictures hardly shrink in a zip: what grows by more than this is no recording. A bomb of a
  // megabyte grows a thousandfold.
  constexpr std::uint64_t kMostGrowth = 10, kMostLists = std::uint64_t(16) << 20U;
  std::uint64_t used = 0;
  for (const fs::directory_entry& one : fs::recursive_directory_iterator(uploads))
    if (one.is_regular_file()) used += one.file_size();
  const fs::path all = uploads / (".unpacked-" + zip.filename().string());
  io::UnzipLimits limits;
  limits.most_bytes = std::min(kMost - std::min(kMost, used),
                               kMostGrowth * std::uint64_t(fs::file_size(zip)) + kMostLists);
  const auto remove_all = [](const fs::path& path) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  };
  // Removes the zip and the unpacked files at the end, also after an error; the recording has been
  // moved to a folder of its own by then.
  struct Removed {
    const std::function<void(const fs::path&)> remove;
    const fs::path &all, &zip;
    ~Removed() {
      remove(all);
      remove(zip);
    }
  } const removed{remove_all, all, zip};
  const fs::path inside = recording_in(zip, limits);
  io::unzip(zip, all, limits);
  const std::string own = inside.filename().string();
  const std::string name = is_upload_name(own) ? own : zip.stem().string();
  fs::path folder = uploads / name;
  for (int i = 2; fs::exists(folder); ++i) folder = uploads / fmt::format("{}-{}", name, i);
  fs::rename(inside.empty() ? all : all / inside, folder);
  try {
    capture::open_tum_folder(folder);  // its error states what is missing
  } catch (...) {
    remove_all(folder);
    throw;
  }
  return folder;
}

std::vector<std::string> paths_of(const json& options) {
  std::vector<std::string> out;
  json copy = options;
  for_paths_of_tables(copy, [&](json& path) { out.push_back(path.get<std::string>()); });
  return out;
}

void save_scene(const std::string& text, const fs::path& from, const std::vector<fs::path>& copied,
                const fs::path& to) {
  const fs::path folder = fs::weakly_canonical(fs::absolute(from)).parent_path(),
                 target = fs::weakly_canonical(fs::absolute(to)).parent_path();
  const std::string files = to.stem().string() + "_files";
  const auto moved = [&](json& value) {
    fs::path file = value.get<std::string>();
    const bool relative = file.is_relative();
    if (relative) file = folder / file;
    if (std::any_of(copied.begin(), copied.end(),
                    [&](const fs::path& one) { return lies_in(file, one); })) {
      fs::create_directories(target / files);
      const fs::path copy = target / files / file.filename();
      if (fs::is_directory(file))
        fs::copy(file, copy, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
      else
        write_file_atomically(copy, [&](std::ostream& out) { out << read_file(file); });
      value = (fs::path(files) / file.filename()).generic_string();
    } else if (relative && fs::absolute(folder).lexically_normal() != target.lexically_normal()) {
      value = fs::absolute(file).lexically_normal().lexically_proximate(target).generic_string();
    }
  };
  const std::string out = with_paths(text, moved);
  write_file_atomically(to, [&](std::ostream& stream) { stream << out; });
}

}  // namespace hyperex::studio
