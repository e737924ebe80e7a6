// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/fold_landmarks.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"

namespace hyperex::anatomy {
namespace {

using face::FoldPoint;

/// The ends of the line lie 7 and 10 mm from these places on the faces on which it was measured.
constexpr double kFarthestFold_m = 0.030;

struct Belongs {
  FoldPoint point;
  Vec3 to;
  const char* words;
};

std::array<Belongs, 3> belongs(const io::Landmarks& landmarks, bool left) {
  const Vec3 wing = landmarks.at(face::ibug(left ? 35 : 31)),
             corner = landmarks.at(face::ibug(left ? 54 : 48));
  return {{{FoldPoint::upper, wing, "the wing of the nose"},
           {FoldPoint::middle, (wing + corner) / 2,
            "the middle between the wing of the nose and the corner of the mouth"},
           {FoldPoint::lower, corner, "the corner of the mouth"}}};
}

/// Of one landmark; empty: nothing.
std::string problem_of(const std::string& name, const Vec3& at, const Belongs& place, bool left,
                       const face::FaceFrame& frame) {
  const double outwards_m = (left ? 1 : -1) * frame.local(at).x();
  if (outwards_m <= 0)
    return fmt::format(
        "landmark {} lies {:.0f} mm beyond the middle of the face: expected on the subject's own "
        "{}",
        name, 1e3 * std::abs(outwards_m), left ? "left" : "right");
  const double far_m = (at - place.to).norm();
  if (far_m > kFarthestFold_m)
    return fmt::format("landmark {} is {:.0f} mm from {}: expected at most {:.0f} mm", name,
                       1e3 * far_m, place.words, 1e3 * kFarthestFold_m);
  return "";
}

}  // namespace

std::vector<std::string> fold_landmark_problems(const io::Landmarks& landmarks) {
  std::vector<std::string> problems;
  for (const bool left : {true, false}) {
    const std::string upper = face::fold_landmark(FoldPoint::upper, left),
                      lower = face::fold_landmark(FoldPoint::lower, left);
    if (!landmarks.contains(upper) && !landmarks.contains(lower) &&
        !landmarks.contains(face::fold_landmark(FoldPoint::middle, left)))
      continue;
    const face::FaceFrame frame = face::face_frame(landmarks);
    const std::size_t before = problems.size();
    for (const Belongs& place : belongs(landmarks, left)) {
      const std::string name = face::fold_landmark(place.point, left);
      const auto found = landmarks.find(name);
      if (found == landmarks.end()) continue;
      std::string problem = problem_of(name, found->second, place, left, frame);
      if (!problem.empty()) problems.push_back(std::move(problem));
    }
    if (problems.size() == before && landmarks.contains(upper) && landmarks.contains(lower) &&
        frame.local(landmarks.at(upper)).y() <= frame.local(landmarks.at(lower)).y())
      problems.push_back(fmt::format(
          "landmark {} lies below {}: expected beside the nose, above it", upper, lower));
  }
  return problems;
}

}  // namespace hyperex::anatomy
