// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/unknown_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "hyperex/core/lower_case.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/scene/keys.hpp"

namespace hyperex::session {
namespace {

using scene::nearest_part;
using scene::sided;
using scene::SidedName;

/// The number at the end of a name; -1 where there is none.
int number_at_end(const std::string& name) {
  std::size_t digits = 0;
  while (digits < name.size() && std::isdigit((unsigned char)name[name.size() - 1 - digits]))
    ++digits;
  return digits == 0 || digits > 2 ? -1 : std::stoi(name.substr(name.size() - digits));
}

/// Anatomical landmarks without their sides.
const std::vector<std::string>& landmark_parts() {
  static const std::vector<std::string> parts = [] {
    std::set<std::string> all;
    for (const auto& entry : face::canonical_face().landmarks)
      if (!face::ibug_number(entry.first)) all.insert(sided(entry.first).part);
    for (const std::string& name : face::optional_landmarks()) all.insert(sided(name).part);
    return std::vector<std::string>(all.begin(), all.end());
  }();
  return parts;
}

/// Whether several parts begin with these words: which is meant is not guessed.
bool begins_several(const std::string& part) {
  const auto begins = [&](const std::string& p) { return p.starts_with(lower_case(part) + "_"); };
  return std::ranges::count_if(landmark_parts(), begins) > 1;
}

}  // namespace

std::string nearest_landmark(const std::string& name) {
  if (face::is_known_landmark(name)) return "";
  if (const int k = number_at_end(name); k >= 0) {
    const std::string ibug = face::ibug(k);
    const std::string stem =
        lower_case(name).substr(0, lower_case(name).find_last_not_of("0123456789") + 1);
    const std::set<std::string> stems = {"", "p", "point_", "ibug", "ibug_", "ibug-", "ibug68"};
    return stems.contains(stem) && face::is_known_landmark(ibug) ? ibug : "";
  }
  const SidedName given = sided(name);
  const std::string near = nearest_part(given.part, landmark_parts());
  if (near.empty() || begins_several(given.part)) return "";
  // One that exists on two sides, given without its side, is not guessed.
  if (const std::string whole = near + given.side; face::is_known_landmark(whole)) return whole;
  return given.side.empty() && face::is_known_landmark(near + "_L") ? near + "_L or " + near + "_R"
                                                                    : "";
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& there_are) {
  const auto is_there = [&](const std::string& one) {
    return std::find(there_are.begin(), there_are.end(), one) != there_are.end();
  };
  // A landmark's name is not misspelt: only its other name is the same point.
  if (face::is_known_landmark(name)) {
    const std::string other = face::other_name(name);
    return is_there(other) ? fmt::format("; did you mean {}?", other) : "";
  }
  std::string near = nearest_landmark(name);
  if (!is_there(near)) near = scene::nearest(name, there_are);
  // Another number is another part of the face.
  if (const auto k = face::ibug_number(near); k && number_at_end(name) != *k) return "";
  if (name.empty() || near.empty() || near == name) return "";
  const std::string side = sided(name).side;
  if (sided(near).side == side) return fmt::format("; did you mean {}?", near);
  const std::string part = sided(near).part;  // a side is never guessed
  return side.empty() && is_there(part + "_R") && is_there(part + "_L")
             ? fmt::format("; did you mean {0}_R or {0}_L?", part)
             : "";
}

std::vector<Note> misspelt_landmarks(std::vector<std::string>& unknown) {
  constexpr std::size_t most = 5;
  std::vector<Note> warnings;
  std::vector<std::string> others;
  for (const std::string& name : unknown) {
    const std::string near = warnings.size() < most ? nearest_landmark(name) : "";
    if (near.empty())
      others.push_back(name);
    else
      warnings.push_back(make_warning(
          "landmarks.misspelt",
          fmt::format("landmark {} is not known and ignored; did you mean {}?", name, near)));
  }
  unknown = std::move(others);
  return warnings;
}

}  // namespace hyperex::session
