// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The table of keys, made from what the structs of options describe (core/describe.hpp): parsing,
// --set, error messages, docs/scene.md and the echo of the options all walk through it.
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
  std::string below;     ///< part of the value: "", "[2]" or "[0].landmark" (0 is the first)
  nlohmann::json value;  ///< null where something is missing
  std::string expected;
};

/// One key of an options struct, without the struct.
struct KeyInfo {
  std::string name = {};  ///< "time.step_s"; of a column only "landmark"
  Kind kind = Kind::text;
  Unit unit = {};
  Bounds range = {0, 0};  ///< numbers: of the value, or of each element; in the unit of the key
  std::vector<std::string> choices = {};  ///< allowed words, besides what the kind allows
  std::size_t least = 0, most = 1000;     ///< lists: how many elements
  bool required = false;                  ///< columns that are not may be left out
  bool folder_too = false;                ///< of a path
  std::string description = {};           ///< a sentence or two
  std::string only_where = {};            ///< a condition without which it has no effect
  std::string member = {};                ///< of the struct: "support.skull_layer.along_pa_per_m"
  std::vector<KeyInfo> columns = {};      ///< rows: the keys of each table
  std::string expected() const;           ///< "a number from 1 to 30 (mm)"
};

/// A key and its field. `set` leaves the field as it was where it complains.
template <class Owner>
struct Field : KeyInfo {
  /// Relative paths are taken from `folder`.
  std::function<std::vector<Complaint>(Owner&, const nlohmann::json& value,
                                       const std::filesystem::path& folder)>
      set = {};
  std::function<nlohmann::json(const Owner&)> get = {};
};
using Key = Field<Scene>;

struct Section {
  std::string name, description;
};

const std::vector<Section>& sections();        ///< in the order of the page; "" holds the top level
const std::vector<Key>& keys();                ///< in the order of the sections
const Key* find_key(const std::string& name);  ///< null where there is none

/// What to give in the place of a key of earlier versions or a constant of a law, in words; empty
/// for every other name.
std::string in_place_of(const std::string& name);

/// Whether a key has a meaning for a drive by displacement alone: those of [region], and of
/// [support] but jaw_points (which muscles, that fit the jaw to all points, can do without).
bool speaks_of_displacement(const std::string& key);

/// Whether a key, where it is given, decides what drives: drive.by, and those that speak of
/// displacement. Where none is given, in the scene or in a variant, muscles drive.
bool decides_the_drive(const std::string& key);

/// What is expected in the place of an unknown name.
std::string one_of_names(const std::string& name, const std::vector<std::string>& names);
/// "a", "b" or "c".
std::string in_words(const std::vector<std::string>& choices);

/// On one line, cut to a readable length; "nan" and "inf" as such.
std::string show(const nlohmann::json& value);

/// "time.step_s" -> "time", "title" -> "".
std::string section_of(const std::string& key);

/// The candidate most like `name`, typing slips, a missing unit or another section allowed for;
/// empty where none is near.
std::string nearest(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace hyperex::scene
