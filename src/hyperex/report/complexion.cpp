// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/complexion.hpp"

#include <cmath>

#include "hyperex/anatomy/eyeballs.hpp"
#include "hyperex/anatomy/known_landmarks.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/report/face_backing.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;

/// Strength of the painted features: 0 shows the plain tone, 1 the lips and brows as painted.
constexpr double kFaint = 0.6;

/// Where each point of the scan lies in the canonical face: its place in the texture, and its depth
/// (m, forward). |points| x 3.
Points canonical_places(const anatomy::KnownLandmarks& known, const Points& points) {
  const face::CanonicalFace& canonical = face::canonical_face();
  Points places = Points::Zero(Index(known.names.size()), 3);
  for (std::size_t i = 0; i < known.names.size(); ++i) {
    const std::vector<int>& vertices = canonical.landmarks.at(known.names[i]);
    for (const int v : vertices)
      places.row(Index(i)).head<2>() +=
          canonical.uv.row(v).cast<double>() / double(vertices.size());
  }
  places.col(2) = known.canonical.col(2);
  const Rbf place(known.given, places,
                  {.polynomial = RbfPolynomial::affine, .merge_distance = 1e-4});
  return place.at_all(points);
}

/// Strength of the painted features at points of these depths. The texture has no place for the
/// back of a head, where it would show the face once more: they fade behind the landmarks.
Eigen::VectorXd strength_at(const anatomy::KnownLandmarks& known, const Eigen::VectorXd& depth_m) {
  constexpr double kFade_m = 0.03;
  const double back_m = known.canonical.col(2).minCoeff() - kFade_m;
  const Eigen::ArrayXd share = ((depth_m.array() - back_m) / kFade_m).max(0).min(1);
  return kFaint * share.square() * (3 - 2 * share);
}

}  // namespace

io::VertexColours complexion(const simulate::Performance& performance, face::SkinTone tone) {
  io::VertexColours colours(0, 4);
  const io::Landmarks landmarks = landmarks_at_rest(performance);
  if (!anatomy::face_corners(landmarks)) return colours;
  const face::SkinPicture& skin = face::painted_skin(tone, face::SkinDetail::soft);
  const auto plain = face::tone_colour(tone);
  const anatomy::KnownLandmarks known = anatomy::known_landmarks(landmarks);
  const Points places = canonical_places(known, performance.skin_rest.points);
  const Eigen::VectorXd strength = strength_at(known, places.col(2));
  colours.resize(places.rows(), 4);
  for (Index v = 0; v < places.rows(); ++v) {
    const auto painted = skin.at(places(v, 0), places(v, 1));
    for (int k = 0; k < 3; ++k) {
      const double shown =
          std::lerp(double(plain[std::size_t(k)]), double(painted[std::size_t(k)]), strength[v]);
      colours(v, k) = static_cast<std::uint8_t>(std::lround(shown));
    }
    colours(v, 3) = 255;
  }
  return colours;
}

}  // namespace hyperex::report
