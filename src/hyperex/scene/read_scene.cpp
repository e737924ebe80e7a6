// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "hyperex/core/files.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/new_scene.hpp"
#include "hyperex/scene/scene_reader.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/scene/values.hpp"
#include "hyperex/scene/variant_names.hpp"

namespace hyperex::scene {
namespace {

/// The name of a key for messages, on one line even if it contains blanks or line breaks.
std::string plain(const std::string& key) {
  const bool bare = std::all_of(key.begin(), key.end(), [](unsigned char c) { return c > ' '; });
  return bare ? key : show(key);
}

bool is_utf8(const std::string& text) {
  try {
    return !json(text).dump().empty();
  } catch (const json::type_error&) {
    return false;
  }
}

}  // namespace

void SceneReader::complain(const Origin& origin, const std::string& key, const json& value,
                           const std::string& expected) {
  problems.push_back(
      {origin.file, origin.line, plain(key), value.is_null() ? "" : show(value), expected});
}

Origin SceneReader::in_file(const std::string& name) const {
  const auto line = lines_.find(name);
  return {scene.file, line == lines_.end() ? 0 : line->second};
}

void SceneReader::take(const std::string& key, const GivenValue& given) {
  if (find_key(key) == nullptr)
    complain(given.origin, key, given.value, unknown_key(key));
  else
    given_[key] = given;
}

void SceneReader::take_section(const std::string& name, const json& value) {
  if (!value.is_object()) {
    complain(in_file(name), name, value, "a section, [" + name + "]");
    return;
  }
  for (const auto& [key, item] : value.items()) {
    const std::string full = name + "." + key;
    take(full, {item, in_file(full), false, scene.file.parent_path()});
  }
}

bool SceneReader::take_file() {
  const auto fail = [&](int line, const std::string& expected) {
    problems.push_back({scene.file, line, "", "", expected});
    return false;
  };
  std::error_code error;
  if (!fs::exists(scene.file, error)) return fail(0, "an existing scene file");
  if (fs::is_directory(scene.file, error)) return fail(0, "a scene file; this is a folder");
  if (const std::string kind = other_kind(scene.file); !kind.empty())
    return fail(0, fmt::format("a scene file, which names a scan and a recording; this is a {0}. "
                               "hyperex new {1} writes one, with {2} = '{3}'",
                               kind,
                               kind == "scan" ? scene.file.filename().string() + " MOTION"
                                              : "SCAN " + scene.file.filename().string(),
                               kind == "scan" ? "scan.file" : recording_key(scene.file),
                               scene.file.filename().string()));
  try {
    return take_text(read_file(scene.file));
  } catch (const InputError&) {
    return fail(0, "a file that can be read");
  }
}

bool SceneReader::take_text(const std::string& text) {
  const auto fail = [&](int line, const std::string& expected) {
    problems.push_back({scene.file, line, "", "", expected});
    return false;
  };
  TomlValues values;
  try {
    values = parse_toml(text);
  } catch (const TornToml& torn) {
    if (torn.comma)
      return fail(torn.line, "decimals behind a point, 0.3 and not 0,3 (" + torn.why + ")");
    return fail(torn.line, "sound TOML (" + torn.why + ")" +
                               (torn.backslash ? "; a backslash between double quotes begins an "
                                                 "escape: put a path of Windows between single "
                                                 "quotes, 'C:\\scans\\me.ply'"
                                               : ""));
  }
  if (values.root.contains("scene") &&
      (values.root.contains("grid") || values.root.contains("cases")))
    return fail(0, "a scene file; this is a study: hyperex sweep " + scene.file.string());
  lines_ = std::move(values.lines);
  for (const auto& [name, value] : values.root.items()) {
    if (name == "variant")
      variants_ = value;
    else if (is_section(name))
      take_section(name, value);
    else if (value.is_object())
      complain(in_file(name), name, nullptr, unknown_section(name));
    else
      take(name, {value, in_file(name), false, scene.file.parent_path()});
  }
  return true;
}

void SceneReader::take_override(const Override& given) {
  const auto& [text, origin, folder] = given;
  const auto equals = text.find('=');
  std::string name = text.substr(0, equals);
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  if (equals == std::string::npos || name.empty() || !is_utf8(text)) {
    complain(origin, "", text, "KEY=VALUE, as in time.step_s=0.001");
    return;
  }
  const json value = override_value(name, text.substr(equals + 1));
  if (is_section(name))
    complain(origin, name, value, "a key of the section, as in " + name + ".KEY=VALUE");
  else if (name == "variant")
    complain(origin, name, value,
             "a key; variants stand in the scene file, and --no-variants of hyperex run and "
             "hyperex check leaves them out");
  else
    take(name, {value, origin, true, folder});
}

/// There is one source of motion: an override replaces the one in the file.
void SceneReader::settle_motion() {
  static constexpr const char* sources[] = {"motion.file", "motion.recording", "motion.openface",
                                            "motion.arkit"};
  const auto overridden = [&](const char* key) {
    const auto found = given_.find(key);
    return found != given_.end() && found->second.is_override;
  };
  const bool any_override = std::any_of(std::begin(sources), std::end(sources), overridden);
  std::vector<const char*> given;
  for (const char* key : sources) {
    if (any_override && !overridden(key)) given_.erase(key);
    if (given_.count(key)) given.push_back(key);
  }
  if (given.empty())
    complain(in_file("motion"), sources[0], nullptr,
             find_key(sources[0])->expected() +
                 ", required; or motion.recording, motion.openface or motion.arkit in its place");
  for (std::size_t i = 1; i < given.size(); ++i)
    complain_given(given[i], fmt::format("one source of motion, and {} is given", given[0]));
}

/// Where this is true and the scene has variants, muscles drive (settle_drive()).
bool SceneReader::drive_is_open() const {
  for (const auto& [key, given] : given_)
    if (decides_the_drive(key, given.value)) return false;
  if (variants_.is_array())
    for (const json& block : variants_) {
      if (!block.is_object()) continue;
      for (const auto& [key, value] : changes_of(block))
        if (decides_the_drive(key, value)) return false;
    }
  return true;
}

void SceneReader::settle_drive() {
  if (variants_.is_array() && drive_is_open()) scene.drive.by = simulate::DriveBy::muscles;
}

void SceneReader::settle_contact() {
  const json finite = word_of(simulate::Strain::finite);
  const auto given = given_.find("tissue.strain");
  bool any_finite = given != given_.end() && given->second.value == finite;
  if (variants_.is_array())
    for (const json& block : variants_) {
      if (!block.is_object()) continue;
      const auto changes = changes_of(block);
      const auto strain = changes.find("tissue.strain");
      any_finite = any_finite || (strain != changes.end() && strain->second == finite);
    }
  scene.contact.lips = !any_finite;
}

void SceneReader::fill() {
  for (const Key& key : keys()) {
    const auto found = given_.find(key.name);
    if (found == given_.end()) {
      if (key.required)
        complain(in_file(section_of(key.name)), key.name, nullptr, key.expected() + ", required");
      continue;
    }
    const auto& [value, origin, is_override, folder] = found->second;
    const bool from_file = !is_override;
    for (const Complaint& complaint : key.set(scene, value, folder))
      complain_part(key.name, complaint.below, complaint.value, complaint.expected);
    scene.origins[key.name] = origin;
    if (!from_file) continue;
    for (auto part = lines_.lower_bound(key.name + "[");
         part != lines_.end() && part->first.rfind(key.name + "[", 0) == 0; ++part)
      scene.origins[part->first] = {scene.file, part->second};
  }
}

void SceneReader::complain_part(const std::string& key, const std::string& below, const json& value,
                                const std::string& expected) {
  const GivenValue& given = given_.at(key);
  const std::string part = key + below;
  Origin at = given.origin;
  if (!given.is_override && lines_.count(part)) at.line = lines_.at(part);
  // A missing column has no line: take that of its table.
  else if (!given.is_override && lines_.count(part.substr(0, part.rfind('.'))))
    at.line = lines_.at(part.substr(0, part.rfind('.')));
  complain(at, part, value, expected);
}

void SceneReader::complain_given(const std::string& key, const std::string& expected) {
  const auto found = given_.find(key);
  if (found == given_.end())
    complain(in_file(section_of(key)), key, nullptr, expected);
  else
    complain(found->second.origin, key, found->second.value, expected);
}

namespace {

/// The scene as far as it could be read, and all problems: those of the file by line, then those of
/// the overrides. `text`: used instead of the file's content; null: the file is read.
SceneReader read(const fs::path& file, const std::vector<Override>& overrides,
                 const std::string* text = nullptr,
                 std::vector<LeftOutVariant>* left_out = nullptr) {
  SceneReader reader(file);
  reader.left_out = left_out;
  if (text ? reader.take_text(*text) : reader.take_file()) {
    for (const Override& given : overrides) reader.take_override(given);
    reader.settle_motion();
    reader.settle_drive();
    reader.settle_contact();
    reader.fill();
    reader.settle_muscles();
    reader.check_together();
    reader.settle_variants();
  }
  std::stable_sort(reader.problems.begin(), reader.problems.end(),
                   [&](const InputProblem& a, const InputProblem& b) {
                     const bool a_set = a.file != file, b_set = b.file != file;
                     return a_set != b_set ? b_set : a.line < b.line;
                   });
  return reader;
}

std::vector<Override> from_command_line(const std::vector<std::string>& texts) {
  std::vector<Override> overrides;
  for (const std::string& text : texts) overrides.push_back({text});
  return overrides;
}

}  // namespace

Scene read_scene_with(const fs::path& file, const std::vector<Override>& overrides) {
  SceneReader reader = read(file, overrides);
  if (!reader.problems.empty()) throw InputError(reader.problems);
  return std::move(reader.scene);
}

Scene read_scene_text(const std::string& text, const fs::path& file,
                      std::vector<LeftOutVariant>* left_out) {
  SceneReader reader = read(file, {}, &text, left_out);
  if (!reader.problems.empty()) throw InputError(reader.problems);
  return std::move(reader.scene);
}

Scene read_scene(const fs::path& file, const std::vector<std::string>& overrides) {
  return read_scene_with(file, from_command_line(overrides));
}

void leave_out_variants(Scene& scene) {
  scene.variants.clear();
  if (!scene.origins.contains("contact.lips"))
    scene.contact.lips = scene.model.strain != simulate::Strain::finite;
}

std::vector<InputProblem> problems_of(const fs::path& file,
                                      const std::vector<std::string>& overrides) {
  return read(file, from_command_line(overrides)).problems;
}

}  // namespace hyperex::scene
