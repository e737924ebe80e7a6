// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The one table of keys: parsing, --set, error messages, docs/scene.md and the echo of the options
// all walk through it, so that a key exists in one place (keys.cpp).
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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

/// Allowed numbers, in the unit of the key.
struct Range {
  double low, high;
  bool above_low = false;  ///< `low` itself is refused
  bool or_zero = false;    ///< 0 is allowed besides
  bool holds(double value) const;
  std::string text() const;  ///< "above 0 to 1e6", "1 to 30", "0, or 1 to 40"
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
  std::string unit = {};                  ///< "mm"; empty where it has none
  Range range = {0, 0};                   ///< numbers: of the value, or of each element
  std::vector<std::string> choices = {};  ///< allowed words, besides what the kind allows
  std::size_t least = 0, most = 1000;     ///< lists: how many elements
  bool required = false;
  bool optional = false;              ///< of a column: may be left out
  std::string description = {};       ///< a sentence or two
  std::vector<KeyInfo> columns = {};  ///< rows: the keys of each table
  std::string expected() const;       ///< "a number from 1 to 30 (mm)"
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

/// Whether a key has a meaning for a drive by displacement alone: those of [region], and of
/// [support] but jaw_points (which muscles, that fit the jaw to all points, can do without).
bool speaks_of_displacement(const std::string& key);

/// On one line, cut to a readable length; "nan" and "inf" as such.
std::string show(const nlohmann::json& value);

/// "time.step_s" -> "time", "title" -> "".
std::string section_of(const std::string& key);

/// The candidate most like `name`, typing slips, a missing unit or another section allowed for;
/// empty where none is near.
std::string nearest(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace hyperex::scene
