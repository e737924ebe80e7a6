// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/landmark_search.hpp"

#include <algorithm>

#include "hyperex/core/error.hpp"
#include "hyperex/tissue/landmark_doubts.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"

namespace hyperex::scene {

LandmarkSearch::LandmarkSearch(const Inputs& inputs) {
  doubts_ = std::async(std::launch::async, [&inputs]() -> std::vector<std::string> {
    io::Landmarks given = inputs.landmarks;
    for (const std::string& name : inputs.placed) given.erase(name);
    try {
      const auto found = tracking::find_scan_landmarks(
          inputs.scan.mesh, tracking::picture_colours(inputs.scan), inputs.scan.file.string());
      return tissue::landmark_doubts(given, found.landmarks);
    } catch (const InputError&) {  // no face in the pictures: nothing to compare with
      return {};
    }
  });
}

std::vector<std::string> LandmarkSearch::doubts(const std::vector<std::string>& said) {
  std::vector<std::string> all = doubts_.get();
  std::erase_if(all, [&](const std::string& doubt) {
    const std::string start = doubt.substr(0, doubt.find(" is ") + 4);  // "landmark NAME is "
    return std::any_of(said.begin(), said.end(),
                       [&](const std::string& one) { return one.starts_with(start); });
  });
  return all;
}

}  // namespace hyperex::scene
