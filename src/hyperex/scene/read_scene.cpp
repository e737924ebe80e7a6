// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "hyperex/core/files.hpp"
#include "hyperex/muscles/muscle_names.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/new_scene.hpp"
#include "hyperex/scene/override.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "hyperex/scene/values.hpp"
#include "hyperex/scene/variant_names.hpp"
#include "hyperex/scene/variant_presets.hpp"

namespace hyperex::scene {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

struct GivenValue {
  json value;
  Origin origin;
  bool is_override = false;
  fs::path folder = {};  ///< relative paths are relative to it
};

/// The name of a key for messages, on one line even if it contains blanks or line breaks.
std::string plain(const std::string& key) {
  const bool bare = std::all_of(key.begin(), key.end(), [](unsigned char c) { return c > ' '; });
  return bare ? key : show(key);
}

/// A scene being read: the values given, the scene made of them, and the problems found.
class Reader {
 public:
  explicit Reader(const fs::path& file) { scene.file = file; }
  /// Returns false where nothing could be read at all.
  bool take_file();
  bool take_text(const std::string& text);
  void take_override(const Override& given);
  void settle_motion();
  /// Whether neither the scene nor a variant gives a key that decides what drives the face
  /// (decides_the_drive()).
  bool drive_is_open() const;
  void settle_drive();
  void fill();
  /// Sets the table of muscles, which is the same for all variants.
  void settle_muscles() { scene.muscles.own = muscles_of_scene(); }
  void check_together();
  /// Fills the scene once more for each variant; its changes replace the values given.
  void settle_variants();

  Scene scene;
  std::vector<InputProblem> problems;

 private:
  void take_section(const std::string& name, const json& value);
  void settle_variant(const json& block, const std::string& at);
  /// The variant's own name, or that of its (known) preset; nothing where the name is not allowed.
  std::optional<std::string> name_of_variant(const json& block, const std::string& at);
  /// The variant's keys, which override those of its preset; empty if there is no such preset.
  std::map<std::string, json> changes_with_preset(const json& block, const std::string& at);
  void take(const std::string& key, const GivenValue& given);
  void complain(const Origin& origin, const std::string& key, const json& value,
                const std::string& expected);
  void complain_given(const std::string& key, const std::string& expected);
  /// Complains about a part of a given key, such as ".zyg_major_L" of muscles.gain.
  void complain_part(const std::string& key, const std::string& below, const json& value,
                     const std::string& expected);
  /// Checks that gains name muscles of the scene's table.
  void check_gains();
  /// Checks for options that finite strain does not support.
  void check_strain();
  muscles::MuscleTable muscles_of_scene();
  Origin in_file(const std::string& name) const;

  std::map<std::string, int> lines_;
  std::map<std::string, GivenValue> given_;
  json variants_;  // [[variant]] as in the file
};

void Reader::complain(const Origin& origin, const std::string& key, const json& value,
                      const std::string& expected) {
  problems.push_back(
      {origin.file, origin.line, plain(key), value.is_null() ? "" : show(value), expected});
}

Origin Reader::in_file(const std::string& name) const {
  const auto line = lines_.find(name);
  return {scene.file, line == lines_.end() ? 0 : line->second};
}

void Reader::take(const std::string& key, const GivenValue& given) {
  if (find_key(key) == nullptr)
    complain(given.origin, key, given.value, unknown_key(key));
  else
    given_[key] = given;
}

void Reader::take_section(const std::string& name, const json& value) {
  if (!value.is_object()) {
    complain(in_file(name), name, value, "a section, [" + name + "]");
    return;
  }
  for (const auto& [key, item] : value.items()) {
    const std::string full = name + "." + key;
    take(full, {item, in_file(full), false, scene.file.parent_path()});
  }
}

bool Reader::take_file() {
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

bool Reader::take_text(const std::string& text) {
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

bool is_utf8(const std::string& text) {
  try {
    return !json(text).dump().empty();
  } catch (const json::type_error&) {
    return false;
  }
}

void Reader::take_override(const Override& given) {
  const auto& [text, origin, folder] = given;
  const auto equals = text.find('=');
  std::string name = text.substr(0, equals);
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  if (equals == std::string::npos || name.empty() || !is_utf8(text)) {
    complain(origin, "", text, "KEY=VALUE, as in time.step_s=0.001");
    return;
  }
  const std::string value_text = text.substr(equals + 1);
  const Key* key = find_key(name);
  json value = parse_toml_value(value_text).value_or(value_text);
  // A file may be called 7 or 2024-01-01, which TOML reads as a number or a date.
  const bool wordy =
      key && (key->kind == Kind::text || key->kind == Kind::choice || key->kind == Kind::path);
  if (wordy && !value.is_string()) value = value_text;
  if (is_section(name))
    complain(origin, name, value, "a key of the section, as in " + name + ".KEY=VALUE");
  else
    take(name, {value, origin, true, folder});
}

/// There is one source of motion: an override replaces the one in the file.
void Reader::settle_motion() {
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
bool Reader::drive_is_open() const {
  for (const auto& [key, given] : given_)
    if (decides_the_drive(key)) return false;
  if (variants_.is_array())
    for (const json& block : variants_) {
      if (!block.is_object()) continue;
      for (const auto& [key, value] : changes_of(block))
        if (decides_the_drive(key)) return false;
    }
  return true;
}

void Reader::settle_drive() {
  if (variants_.is_array() && drive_is_open()) scene.drive.by = simulate::DriveBy::muscles;
}

void Reader::fill() {
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

void Reader::complain_part(const std::string& key, const std::string& below, const json& value,
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

void Reader::complain_given(const std::string& key, const std::string& expected) {
  const auto found = given_.find(key);
  if (found == given_.end())
    complain(in_file(section_of(key)), key, nullptr, expected);
  else
    complain(found->second.origin, key, found->second.value, expected);
}

/// Empty where the program's own table is used.
muscles::MuscleTable Reader::muscles_of_scene() {
  if (scene.muscles_file.empty() && scene.muscles_without.empty()) return {};
  muscles::MuscleTable all;
  try {
    muscles::MuscleTable own;
    if (const fs::path& file = scene.muscles_file; !file.empty())
      own = muscles::read_muscles(read_file(file), file.string());
    all = muscles::changed_table(muscles::muscle_template(), own, {});
  } catch (const InputError& error) {
    complain_given("muscles.file", fmt::format("sound tables of muscles ({})", error.what()));
    return {};
  }
  std::vector<std::string> names;
  for (const muscles::TemplateMuscle& muscle : all) names.push_back(muscle.name);
  for (const std::string& name : scene.muscles_without)
    if (!muscles::find_muscle(name, all))
      complain_given("muscles.without", fmt::format("names of muscles without side; {} is none: {}",
                                                    name, one_of_names(name, names)));
  muscles::MuscleTable left = muscles::changed_table(all, {}, scene.muscles_without);
  if (left.empty()) complain_given("muscles.without", "one muscle or more left");
  return left;
}

void Reader::check_gains() {
  const std::vector<std::string> names = muscles::gain_names(scene.muscles.table());
  for (const simulate::MuscleGain& gain : scene.muscles.gains) {
    if (std::find(names.begin(), names.end(), gain.muscle) != names.end()) continue;
    complain_part("muscles.gain", "." + gain.muscle, gain.gain,
                  expected_gain(gain.muscle, names, scene.muscles.table()));
  }
}

void Reader::check_strain() {
  const simulate::ModelOptions& model = scene.model;
  if (model.strain != simulate::Strain::finite) return;
  if (model.viscous_form != fem::ViscousForm::isotropic)
    complain_given("tissue.viscous_form", "\"isotropic\", as tissue.strain is \"finite\"");
  if (scene.drive.by == simulate::DriveBy::reactions)
    complain_given("drive.by", "\"displacement\" or \"muscles\", as tissue.strain is \"finite\"");
  if (const double least = fem::least_c20(model.law); model.law.c20 < least)
    complain_given("tissue.yeoh_c20",
                   fmt::format("at least {:g}, -sqrt(3 tissue.yeoh_c30): below, stress falls "
                               "where stretch grows",
                               least));
}

void Reader::check_together() {
  check_gains();
  check_strain();
  if (scene.region.measured == simulate::Measured::points && scene.region.measured_points.empty())
    complain_given("region.measured_points", "one or more names, as region.measured is \"points\"");
  if (scene.mesh.thickness_m != 0 && !scene.mesh.depths.empty())
    complain_given("mesh.thickness_mm", "0, as [[mesh.thickness_point]] is given");
  if (scene.region.measured == simulate::Measured::none && !scene.drive.all_points &&
      scene.drive.points.empty())
    complain_given("drive.points", "one or more names, or \"all\", as region.measured is \"none\"");
  const bool by_muscles = scene.drive.by == simulate::DriveBy::muscles || drive_is_open();
  for (const auto& [key, given] : {std::pair{"muscles.gain", !scene.muscles.gains.empty()},
                                   {"muscles.mirrored", scene.muscles.mirrored},
                                   {"muscles.shape_prior", !scene.muscles.shape_prior},
                                   {"muscles.file", !scene.muscles_file.empty()},
                                   {"muscles.without", !scene.muscles_without.empty()}})
    if (!by_muscles && given)
      complain_given(key, "drive.by = \"muscles\" in the scene: muscles move nothing otherwise");
  if (scene.drive.by != simulate::DriveBy::displacement &&
      scene.region.measured != simulate::Measured::none)
    complain_given("region.measured", "\"none\", as drive.by is not \"displacement\"");
  if (scene.solver.newmark_gamma > 2 * scene.solver.newmark_beta)
    complain_given("solver.newmark_gamma",
                   "at most twice solver.newmark_beta: beyond, steps are not always stable");
  if (scene.time.end_s > simulate::kMostSteps * scene.time.step_s)
    complain_given("time.step_s", fmt::format("at least {:g}, for at most {:.0f} steps to "
                                              "time.end_s = {:g}",
                                              scene.time.end_s / simulate::kMostSteps,
                                              simulate::kMostSteps, scene.time.end_s));
  if (scene.time.end_s != 0 && scene.time.end_s < scene.time.step_s)
    complain_given("time.end_s", "0, or at least one time.step_s");
}

std::map<std::string, json> Reader::changes_with_preset(const json& block, const std::string& at) {
  const json given = block.value("preset", json());
  json own = block;
  own.erase("preset");
  std::map<std::string, json> changes = changes_of(own);
  if (given.is_null()) return changes;
  const VariantPreset* preset =
      given.is_string() ? find_variant_preset(given.get<std::string>()) : nullptr;
  if (!preset) {
    std::vector<std::string> names;
    for (const VariantPreset& one : variant_presets()) names.push_back(one.name);
    complain(in_file(at + ".preset"), at + ".preset", given,
             one_of_names(given.is_string() ? given.get<std::string>() : "", names));
    return {};
  }
  changes.merge(changes_of(preset->changes));  // keys that are there stay: the variant's own
  return changes;
}

std::optional<std::string> Reader::name_of_variant(const json& block, const std::string& at) {
  const bool by_preset = !block.contains("name") && block.contains("preset");
  const std::string place = at + (by_preset ? ".preset" : ".name");
  const json name = block.value(by_preset ? "preset" : "name", json());
  const std::string expected = by_preset ? "" : expected_variant_name(name);
  if (!expected.empty()) {
    complain(in_file(name.is_null() ? at : place), place, name, expected);
    return std::nullopt;
  }
  for (const Variant& other : scene.variants)
    if (other.name == name)
      complain(in_file(place), place, name,
               by_preset ? "a name beside it, as another variant is called so"
                         : "a name that no other variant has");
  return name.get<std::string>();
}

void Reader::settle_variant(const json& block, const std::string& at) {
  if (!block.is_object()) {
    complain(in_file(at), at, block, "a table, [[variant]]");
    return;
  }
  const std::size_t wrong = problems.size();
  const std::map<std::string, json> changes = changes_with_preset(block, at);
  if (problems.size() > wrong) return;
  const std::optional<std::string> name = name_of_variant(block, at);
  if (!name) return;
  Reader varied = *this;
  varied.problems.clear();
  varied.scene.variants.clear();
  Variant variant;
  variant.name = *name;
  variant.folder = variant_folder(variant.name, scene.variants);
  variant.changes = json::object();
  for (const auto& [key, value] : changes) {
    const bool of_preset = !lines_.count(at + "." + key) && block.contains("preset");
    const std::string place = at + "." + (of_preset ? "preset" : key);
    if (find_key(key) != nullptr && !may_vary(key)) {
      complain(in_file(place), place, value, "a key of what may vary: " + what_may_vary());
      continue;
    }
    varied.take(key, {value, in_file(place), false, scene.file.parent_path()});
    varied.lines_[key] = in_file(place).line;
    variant.changes[key] = value;
  }
  if (changes.empty())
    complain(in_file(at), at, nullptr,
             "at least one key that it changes, as in tissue.young_kpa = 400, or a preset");
  varied.fill();
  varied.check_together();
  for (InputProblem& problem : varied.problems) {
    problem.key = at + "." + problem.key;
    problems.push_back(std::move(problem));
  }
  variant.scene = std::move(varied.scene);
  scene.variants.push_back(std::move(variant));
}

void Reader::settle_variants() {
  if (variants_.is_null() || !problems.empty()) return;  // else each would repeat them
  if (!variants_.is_array()) {
    complain(in_file("variant"), "variant", nullptr, "tables, [[variant]]");
    return;
  }
  for (std::size_t i = 0; i < variants_.size(); ++i)
    settle_variant(variants_[i], fmt::format("variant[{}]", i));
}

/// The scene as far as it could be read, and all problems: those of the file by line, then those of
/// the overrides. `text`: used instead of the file's content; null: the file is read.
Reader read(const fs::path& file, const std::vector<Override>& overrides,
            const std::string* text = nullptr) {
  Reader reader(file);
  if (text ? reader.take_text(*text) : reader.take_file()) {
    for (const Override& given : overrides) reader.take_override(given);
    reader.settle_motion();
    reader.settle_drive();
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
  Reader reader = read(file, overrides);
  if (!reader.problems.empty()) throw InputError(reader.problems);
  return std::move(reader.scene);
}

Scene read_scene_text(const std::string& text, const fs::path& file) {
  Reader reader = read(file, {}, &text);
  if (!reader.problems.empty()) throw InputError(reader.problems);
  return std::move(reader.scene);
}

Scene read_scene(const fs::path& file, const std::vector<std::string>& overrides) {
  return read_scene_with(file, from_command_line(overrides));
}

std::vector<InputProblem> problems_of(const fs::path& file,
                                      const std::vector<std::string>& overrides) {
  return read(file, from_command_line(overrides)).problems;
}

}  // namespace hyperex::scene
