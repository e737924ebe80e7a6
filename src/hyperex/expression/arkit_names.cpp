// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/arkit_names.hpp"

#include <algorithm>

namespace hyperex::expression {

std::vector<std::string> arkit_names(const std::string& pattern) {
  if (pattern.empty()) return {};
  const auto star = pattern.find('*');
  if (star == std::string::npos) return {pattern};
  std::string left = pattern, right = pattern;
  left.replace(star, 1, "Left");
  right.replace(star, 1, "Right");
  return {left, right};
}

const std::vector<std::string>& arkit_shapes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const char* pattern :
         {"browDown*",      "browInnerUp",     "browOuterUp*",    "cheekPuff",       "cheekSquint*",
          "eyeBlink*",      "eyeLookDown*",    "eyeLookIn*",      "eyeLookOut*",     "eyeLookUp*",
          "eyeSquint*",     "eyeWide*",        "jawForward",      "jawLeft",         "jawOpen",
          "jawRight",       "mouthClose",      "mouthDimple*",    "mouthFrown*",     "mouthFunnel",
          "mouthLeft",      "mouthLowerDown*", "mouthPress*",     "mouthPucker",     "mouthRight",
          "mouthRollLower", "mouthRollUpper",  "mouthShrugLower", "mouthShrugUpper", "mouthSmile*",
          "mouthStretch*",  "mouthUpperUp*",   "noseSneer*",      "tongueOut"})
      for (const auto& name : arkit_names(pattern)) all.push_back(name);
    return all;
  }();
  return names;
}

std::string arkit_name_of(std::string written) {
  const auto known = [](const std::string& one) {
    const auto& all = arkit_shapes();
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  if (!written.empty() && written.front() >= 'A' && written.front() <= 'Z')
    written.front() += 'a' - 'A';
  if (known(written)) return written;
  if (!written.ends_with("_L") && !written.ends_with("_R")) return "";
  const std::string bare = written.substr(0, written.size() - 2);
  const std::string sided = bare + (written.back() == 'L' ? "Left" : "Right");
  return known(sided) ? sided : known(bare) ? bare : "";
}

}  // namespace hyperex::expression
