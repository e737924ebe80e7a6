// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_names.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

namespace hyperex::muscles {

namespace {
/// Letters in small, all else parts them.
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
}  // namespace

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
