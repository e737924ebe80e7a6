// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A struct of options describes them once, beside its members, for everything that reads them:
// scene files and their reference, checks of bounds, Python and its type stubs, tests.
//
//   struct TimeOptions {
//     double step_s = 0.002;
//     static constexpr const char* about = "Steps and frames.";
//     template <class Visitor>
//     static void describe(Visitor& visitor) {
//       visitor.option(HX_MEMBER(step_s), "The time step.",
//                      {.unit = kSeconds, .bounds = {1e-6, 0.1}});
//     }
//   };
//
// A visitor has three functions. `at` returns the member of the options that are handed to it:
//   option(name, at, sentence, details = {})   a value, a list, or options described in turn
//   one_or_all(name, at, all_name, all_at, sentence)   a list of names, or a flag: all there are
//   factors(name, at, words, sentence, details)  rows of a name (one of `words`) and a number
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "hyperex/core/bounds.hpp"

/// The name of a member, "skull_layer.along_pa_per_m", and a function that returns that member.
#define HX_MEMBER(member)                     \
#member, [](auto& options) -> auto& {       \
    return options.member; /* const or not */ \
  }

namespace hyperex {

/// The unit of an option in scene files, and in the program (SI), with the endings of their names.
/// SI = value * times / over: two exact integers, so that 9 mm is 0.009 to the last bit.
struct Unit {
  const char* name = "";       ///< "kPa/mm"
  const char* ending = "";     ///< of keys: "_kpa_per_mm"
  const char* si_name = "";    ///< "Pa/m"
  const char* si_ending = "";  ///< of members: "_pa_per_m"
  double times = 1, over = 1;
  constexpr double to_si(double value) const { return value * times / over; }
  double from_si(double si) const;  ///< rounded to 15 digits: 9 again
  Bounds from_si(const Bounds& si) const;
};

inline constexpr Unit kMillimetres{"mm", "_mm", "m", "_m", 1, 1000};
inline constexpr Unit kMillilitres{"ml", "_ml", "m^3", "_m3", 1, 1000000};
inline constexpr Unit kSeconds{"s", "_s", "s", "_s"};
inline constexpr Unit kHertz{"Hz", "_hz", "Hz", "_hz"};
inline constexpr Unit kDegrees{"deg", "_deg", "deg", "_deg"};
inline constexpr Unit kMegabytes{"MB", "_mb", "MB", "_mb"};
inline constexpr Unit kGigabytes{"GB", "_gb", "GB", "_gb"};
inline constexpr Unit kKilopascals{"kPa", "_kpa", "Pa", "_pa", 1000, 1};
inline constexpr Unit kKilopascalsPerMillimetre{"kPa/mm",    "_kpa_per_mm", "Pa/m",
                                                "_pa_per_m", 1000000,       1};
inline constexpr Unit kPascalSeconds{"Pa s", "_pa_s", "Pa s", "_pa_s"};
inline constexpr Unit kKilogramsPerCubicMetre{"kg/m^3", "_kg_m3", "kg/m^3", "_kg_m3"};

/// Details of an option, in addition to its sentence.
struct OptionDetails {
  Unit unit = {};
  Bounds bounds = {0, std::numeric_limits<double>::infinity()};  ///< for numbers, SI
  /// Key in scene files where it differs from the member's name (in the unit of keys): within its
  /// section, or the whole key if it contains a dot. For options described in turn: the prefix of
  /// their keys.
  const char* key = nullptr;
  const char* name = nullptr;  ///< in Python, where it is not the member's
  bool in_scene = true;        ///< false: from C++ and Python alone
  bool required = false;       ///< in scene files
  std::size_t least = 0;       ///< number of elements; for a text: of characters
  std::size_t most = 1000;
  /// For a truth value: the words for true and for false. For a text: its allowed values.
  std::array<const char*, 3> words = {};
  const char* none = nullptr;   ///< the word of an optional that holds nothing
  bool folder_too = false;      ///< for a path: folders are allowed
  const char* only_where = "";  ///< a condition without which it has no effect
  /// The word of a scene that does not give it, where that is not the member's default.
  const char* scene_default = "";
};

/// A value of an enumeration and its word, spelled once, by words_of(Enum) beside the enumeration:
///   constexpr auto words_of(Hold) { return std::array{Word{"held", Hold::held}, ...}; }
template <class Value>
struct Word {
  std::string_view text;
  Value value;
};
template <class Value>
Word(const char*, Value) -> Word<Value>;

template <class Enum>
concept Worded = requires(Enum value) {
  words_of(value);
};

/// Empty for a value without a word.
template <Worded Enum>
constexpr std::string_view word_of(Enum value) {
  for (const Word<Enum>& word : words_of(value))
    if (word.value == value) return word.text;
  return {};
}

template <Worded Enum>
constexpr std::optional<Enum> value_of(std::string_view text) {
  for (const Word<Enum>& word : words_of(Enum{}))
    if (word.text == text) return word.value;
  return std::nullopt;
}

template <class Options>
concept Described = requires {
  Options::about;
};

/// The key of a member within its section: "patch_radius_m" in millimetres is "patch_radius_mm".
std::string key_of(std::string_view member, const OptionDetails& details);

inline std::string python_name(std::string_view member, const OptionDetails& details) {
  return std::string(details.name ? details.name : member);
}

}  // namespace hyperex
