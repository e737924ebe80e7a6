// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/words_to_point.hpp"

#include <cctype>
#include <map>
#include <set>

#include "hyperex/core/lower_case.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/face/same_place.hpp"

namespace hyperex::face {
namespace {

using Words = std::multiset<std::string>;

/// The words that tell points apart, in lower case: "Mouth_corner R" has corner, mouth, right. What
/// stands in brackets, as the terms of point_words() do, is left out.
Words telling_words(std::string text) {
  if (const auto open = text.find('('); open != text.npos)
    text.erase(open, text.find(')', open) - open);
  static const std::map<std::string, std::string> same = {
      {"l", "left"}, {"r", "right"}, {"eyebrow", "brow"}, {"lid", "eyelid"}, {"centre", "middle"}};
  static const std::set<std::string> telling_nothing = {"of", "the", "a", "point", "marker"};
  Words out;
  std::string word;
  for (const char c : lower_case(text.substr(0, 100)) + " ") {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += c;
      continue;
    }
    if (const auto known = same.find(word); known != same.end()) word = known->second;
    if (!word.empty() && !telling_nothing.contains(word)) out.insert(word);
    word.clear();
  }
  return out;
}

/// Each landmark by its words.
const std::map<Words, std::string>& landmarks_by_words() {
  static const std::map<Words, std::string> all = [] {
    std::map<Words, std::string> table;
    for (const std::string& name : all_ibug()) table[telling_words(point_words(name))] = name;
    for (const auto& [name, vertices] : canonical_face().landmarks) {
      if (ibug_number(name)) continue;
      const std::string other = other_name(name);
      // Words of an iBUG point stay with it: "chin" is ibug68_8 before pogonion.
      table.emplace(telling_words(point_words(name)), other.empty() ? name : other);
    }
    return table;
  }();
  return all;
}

}  // namespace

std::string name_of_words(const std::string& words) {
  const auto found = landmarks_by_words().find(telling_words(words));
  return found == landmarks_by_words().end() ? "" : found->second;
}

bool moves_with_mouth(const std::string& name) {
  static const std::set<std::string> others = {"stomion", "pogonion", "crista_philtri_superior_L",
                                               "crista_philtri_superior_R"};
  if (const auto k = ibug_number_of_place(name)) return (4 <= *k && *k <= 12) || 48 <= *k;
  if (others.contains(name)) return true;
  const Words words = telling_words(name);
  return words.contains("lip") || words.contains("lips") || words.contains("chin") ||
         words.contains("mouth");
}

}  // namespace hyperex::face
