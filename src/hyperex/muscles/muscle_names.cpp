// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

namespace hyperex::muscles {

namespace {
/// The words of a text in lower case; all characters other than letters separate words.
std::set<std::string> words_of(const std::string& text) {
  std::set<std::string> words;
  std::string word;
  for (const char c : text + ' ')
    if (std::isalpha(static_cast<unsigned char>(c)))
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!word.empty())
      words.insert(std::exchange(word, {}));
  return words;
}

/// The side that the words name: "L", "R", or "" for neither or both. Its words are removed from
/// `words`.
std::string side_in(std::set<std::string>& words) {
  const bool right = words.erase("right") + words.erase("r") > 0;
  const bool left = words.erase("left") + words.erase("l") > 0;
  return right == left ? "" : right ? "R" : "L";
}

/// Appends `stem` with the side; with both sides, right first, where `side` is empty.
void add_sided(const std::string& stem, const std::string& side, std::vector<std::string>& names) {
  for (const char* one : {"R", "L"})
    if (side.empty() || side == one) names.push_back(stem + "_" + one);
}

std::vector<std::string> branches_of(const MuscleTable& among) {
  std::vector<std::string> branches;
  for (const TemplateMuscle& muscle : among)
    if (std::find(branches.begin(), branches.end(), muscle.branch) == branches.end())
      branches.push_back(muscle.branch);
  return branches;
}

}  // namespace

std::vector<std::string> gains_meant(const std::string& name, const MuscleTable& among) {
  std::set<std::string> words = words_of(name);
  const bool sided = words.contains("right") || words.contains("left") || words.contains("r") ||
                     words.contains("l");
  const std::string side = side_in(words);
  bool whole = words.erase("side") > 0;
  for (const char* word : {"half", "face", "whole", "all", "muscles", "muscle"})
    whole = words.erase(word) > 0 || whole;
  std::vector<std::string> meant;
  if (words.empty() && (whole || sided)) add_sided("side", side, meant);
  if (words.empty()) return meant;
  for (const char* word : {"nerve", "branch"}) words.erase(word);
  for (const std::string& branch : branches_of(among))
    if (words == std::set<std::string>{branch}) add_sided(branch, side, meant);
  constexpr std::size_t handful = 4;
  for (const TemplateMuscle& muscle : among) {
    std::set<std::string> known = words_of(muscle.latin);
    known.merge(words_of(muscle.name));
    if (!words.empty() && meant.size() < handful &&
        std::includes(known.begin(), known.end(), words.begin(), words.end()))
      add_sided(muscle.name, side, meant);
  }
  return meant;
}

std::string gain_expected(const std::string& name, const MuscleTable& among) {
  const std::vector<std::string> meant = gains_meant(name, among);
  if (!meant.empty())
    return fmt::format("another name; did you mean {}?", fmt::join(meant, " or "));
  std::vector<std::string> first;
  add_sided("side", "", first);
  for (const std::string& branch : branches_of(among)) add_sided(branch, "", first);
  return fmt::format(
      "a side or a branch of the facial nerve, one of {}; or a muscle, such as "
      "{}_R (hyperex presets lists all)",
      fmt::join(first, ", "), among.front().name);
}

std::vector<std::string> muscles_called(const std::string& name, const MuscleTable& among) {
  std::vector<std::string> called;
  if (!name.ends_with("_L") && !name.ends_with("_R")) return called;
  const std::set<std::string> given = words_of(name.substr(0, name.size() - 2));
  if (given.empty()) return called;
  for (const TemplateMuscle& muscle : among) {
    const std::set<std::string> latin = words_of(muscle.latin);
    if (std::includes(latin.begin(), latin.end(), given.begin(), given.end()))
      called.push_back(muscle.name + name.substr(name.size() - 2));
  }
  return called;
}

}  // namespace hyperex::muscles
