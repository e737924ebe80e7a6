// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/optional_landmarks.hpp"

#include <algorithm>

#include "hyperex/face/canonical_face.hpp"

namespace hyperex::face {

std::string fold_landmark(FoldPoint point, bool left) {
  const char* place = point == FoldPoint::upper    ? "upper"
                      : point == FoldPoint::middle ? "middle"
                                                   : "lower";
  return std::string("nasolabial_fold_") + place + (left ? "_L" : "_R");
}

const std::vector<std::string>& optional_landmarks() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> made;
    for (const FoldPoint point : {FoldPoint::upper, FoldPoint::middle, FoldPoint::lower})
      for (const bool left : {true, false}) made.push_back(fold_landmark(point, left));
    std::ranges::sort(made);
    return made;
  }();
  return names;
}

bool is_optional_landmark(const std::string& name) {
  return std::ranges::binary_search(optional_landmarks(), name);
}

bool is_known_landmark(const std::string& name) {
  return canonical_face().landmarks.contains(name) || is_optional_landmark(name);
}

}  // namespace hyperex::face
