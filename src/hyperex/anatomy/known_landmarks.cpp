// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/known_landmarks.hpp"

#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex::anatomy {

KnownLandmarks known_landmarks(const io::Landmarks& given) {
  const CanonicalFace& face = canonical_face();
  KnownLandmarks known;
  for (const auto& [name, position] : given)
    if (face.landmarks.contains(name)) known.names.push_back(name);
  known.canonical.resize(Eigen::Index(known.names.size()), 3);
  known.given = known.canonical;
  for (Eigen::Index i = 0; i < known.canonical.rows(); ++i) {
    known.canonical.row(i) = face.landmark(known.names[std::size_t(i)], face.mesh.points);
    known.given.row(i) = given.at(known.names[std::size_t(i)]);
  }
  return known;
}

}  // namespace hyperex::anatomy
