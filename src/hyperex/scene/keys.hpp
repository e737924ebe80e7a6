// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The table of keys, made from the descriptions in the structs of options (core/describe.hpp).
// Parsing, --set, error messages, docs/scene.md and the echo of the options all use it.
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

enum class Kind {
  flag,
  integer,
  number,
  numbers,
  text,
  choice,
  path,
  names,
  places,
  factors,
  rows
};

/// What is wrong with a value.
struct Complaint {
  std::string below;     ///< position in the value: "", "[2]" or "[0].landmark" (0 is the first)
  nlohmann::json value;  ///< null where something is missing
  std::string expected;
};

/// One key of an options struct, without the struct.
struct KeyInfo {
  std::string name = {};  ///< "time.step_s"; for a column only "landmark"
  Kind kind = Kind::text;
  Unit unit = {};
  Bounds range = {0, 0};  ///< numbers: of the value or of each element, in the unit of the key
  std::vector<std::string> choices = {};  ///< allowed words, besides what the kind allows
  std::size_t least = 0, most = 1000;     ///< lists: how many elements
  bool required = false;                  ///< columns: whether it must be given
  bool folder_too = false;                ///< paths: whether a folder is allowed too
  std::string description = {};           ///< a sentence or two
  std::string only_where = {};            ///< when the key has an effect; empty: always
  std::string scene_default = {};         ///< OptionDetails::scene_default
  std::string member = {};                ///< in the struct: "support.skull_layer.along_pa_per_m"
  std::vector<KeyInfo> columns = {};      ///< rows: the keys of each table
  std::string expected() const;           ///< "a number from 1 to 30 (mm)"
};

/// A key and access to its field. Where `set` returns complaints, the field is unchanged.
template <class Owner>
struct Field : KeyInfo {
  /// Relative paths are relative to `folder`.
  std::function<std::vector<Complaint>(Owner&, const nlohmann::json& value,
                                       const std::filesystem::path& folder)>
      set = {};
  std::function<nlohmann::json(const Owner&)> get = {};
};
using Key = Field<Scene>;

struct Section {
  std::string name, description;
};

const std::vector<Section>& sections();        ///< in the order of the page; "" is the top level
const std::vector<Key>& keys();                ///< in the order of the sections
const Key* find_key(const std::string& name);  ///< null where there is none

/// The value of a scene that does not give the key, in the unit of the key. That of drive.by is
/// what a scene chooses where no other key decides (session/drive_choice.hpp), not its member's.
nlohmann::json default_of(const Key& key);

/// A text that says what to use instead of a key of earlier versions or a constant of a law; empty
/// for every other name.
std::string in_place_of(const std::string& name);

/// Whether a key with this value has no meaning where muscles drive the face: a region.measured
/// other than "none", and the stiffnesses of [support]. Muscles have stiffnesses of their own in
/// their place (simulate/load/muscle_tissue.hpp). They use support.border, skull and mandible as
/// they are given, and fit the jaw to all points, whatever support.jaw_points says. The other keys
/// of [region] have an effect only beside region.measured.
bool needs_displacement(const std::string& key, const nlohmann::json& value);

/// Whether a key, if it is given with this value, decides what drives the face: drive.by, and the
/// keys of needs_displacement(). Where a scene has variants and none of these keys is given, in the
/// scene or in a variant, muscles drive. (A FaceSession also chooses muscles where there are no
/// variants: session/drive_choice.hpp.)
bool decides_the_drive(const std::string& key, const nlohmann::json& value);

/// The expected text for an unknown name: the nearest of `names`, or all of them.
std::string one_of_names(const std::string& name, const std::vector<std::string>& names);
/// "a", "b" or "c".
std::string in_words(const std::vector<std::string>& choices);

/// A value on one line, cut to a readable length; "nan" and "inf" are written as such.
std::string show(const nlohmann::json& value);

/// "time.step_s" -> "time", "title" -> "".
std::string section_of(const std::string& key);

/// The candidate most like `name`, allowing for typing errors, a missing unit or another section;
/// empty where none is similar.
std::string nearest(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace hyperex::scene
