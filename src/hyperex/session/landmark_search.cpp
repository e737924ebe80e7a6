// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/landmark_search.hpp"

#include <algorithm>
#include <optional>

#include "hyperex/anatomy/known_landmarks.hpp"
#include "hyperex/anatomy/landmark_doubts.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/session/kept.hpp"

namespace hyperex::session {

namespace {

/// The canonical face on given landmarks, those far off left out the second time; none where too
/// few are given.
std::optional<Similarity> canonical_face_on(const io::Landmarks& given) {
  const anatomy::KnownLandmarks known = anatomy::known_landmarks(given);
  if (known.names.size() < 6) return std::nullopt;
  const Similarity first = fit_similarity(known.canonical, known.given);
  const Eigen::VectorXd off = (first.apply(known.canonical) - known.given).rowwise().norm();
  const double most = 2 * rms_distance(first.apply(known.canonical), known.given);
  return fit_similarity(known.canonical, known.given,
                        (off.array() <= most).cast<double>().matrix());
}

}  // namespace

LandmarkSearch::LandmarkSearch(const Inputs& inputs, const KeptResults& kept) {
  doubts_ = std::async(std::launch::async, [&inputs, kept]() -> std::vector<Note> {
    io::Landmarks given = inputs.landmarks;
    for (const std::string& name : inputs.placed) given.erase(name);
    try {
      const FoundLandmarks found = landmarks_on(inputs.scan, canonical_face_on(given), kept);
      return anatomy::landmark_doubts(given, found.landmarks);
    } catch (const InputError&) {  // no face in the pictures: nothing to compare with
      return {};
    }
  });
}

std::vector<Note> LandmarkSearch::doubts(const std::vector<Note>& said) {
  std::vector<Note> all = doubts_.get();
  std::erase_if(all, [&](const Note& doubt) {
    // "landmark NAME is "
    const std::string start = doubt.text.substr(0, doubt.text.find(" is ") + 4);
    return std::any_of(said.begin(), said.end(), [&](const Note& one) {
      return one.id == doubt.id && one.text.starts_with(start);
    });
  });
  return all;
}

}  // namespace hyperex::session
