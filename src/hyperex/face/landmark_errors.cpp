// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/landmark_errors.hpp"

#include "hyperex/face/same_place.hpp"

namespace hyperex::face {

io::Landmarks with_errors(io::Landmarks landmarks, double sigma_m, std::mt19937& random) {
  std::normal_distribution<double> normal(0, sigma_m);
  const io::Landmarks before = landmarks;
  for (auto& [name, place] : landmarks) {
    const Vec3 moved = place + Vec3::NullaryExpr([&](auto) { return normal(random); });
    const auto other = landmarks.find(other_name(name));
    const bool twice = other != landmarks.end() && before.at(other->first) == before.at(name);
    place = twice && other->first < name ? other->second : moved;
  }
  return landmarks;
}

}  // namespace hyperex::face
