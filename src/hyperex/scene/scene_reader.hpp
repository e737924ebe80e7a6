// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/scene/override.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {
namespace fs = std::filesystem;
using nlohmann::json;

struct GivenValue {
  json value;
  Origin origin;
  bool is_override = false;
  fs::path folder = {};  ///< relative paths are relative to it
};

/// A scene being read: the values given, the scene made of them, and the problems found.
class SceneReader {
 public:
  explicit SceneReader(const fs::path& file) { scene.file = file; }
  /// Returns false where nothing could be read at all.
  bool take_file();
  bool take_text(const std::string& text);
  void take_override(const Override& given);
  void settle_motion();
  /// Whether neither the scene nor a variant gives a key that decides what drives the face
  /// (decides_the_drive()).
  bool drive_is_open() const;
  void settle_drive();
  /// Sets contact.lips as a scene has it that does not give the key.
  void settle_contact();
  void fill();
  /// Sets the table of muscles, which is the same for all variants.
  void settle_muscles() { scene.muscles.own = muscles_of_scene(); }
  void check_together();
  /// Fills the scene once more for each variant; its changes replace the values given.
  void settle_variants();

  Scene scene;
  std::vector<InputProblem> problems;
  /// Where given, variants with problems are left out: they and their problems go here.
  std::vector<LeftOutVariant>* left_out = nullptr;

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
  /// The names of tissue.region, whose landmarks are checked once those of the scan are known.
  void check_region_names();
  /// Checks for options that what drives the face does not support.
  void check_drive();
  /// Checks that each segment of bone is cut as its part can be.
  void check_bones();
  muscles::MuscleTable muscles_of_scene();
  Origin in_file(const std::string& name) const;

  std::map<std::string, int> lines_;
  std::map<std::string, GivenValue> given_;
  json variants_;  // [[variant]] as in the file
};

}  // namespace hyperex::scene
