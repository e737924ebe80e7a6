// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/second_face.hpp"

#include <vector>

#include "hyperex/sample/bumps.hpp"

namespace hyperex::sample {
namespace {

const Vec3 kProportions(0.96, 1.035, 1.0);

/// x to the subject's left, y up, z forward; mm.
const std::vector<Bump> kShape = {
    // jaw
    {"pogonion", {0, -6, 1.5}, 24},
    {"ibug68_5", {-3, -3, 0}, 22},
    {"ibug68_11", {3, -3, 0}, 22},
    {"ibug68_3", {-3, 0, 0}, 24},
    {"ibug68_13", {3, 0, 0}, 24},
    // mouth
    {"cheilion_R", {-2.5, 0, -0.5}, 13},
    {"cheilion_L", {2.5, 0, -0.5}, 13},
    {"labiale_inferius", {0, -0.4, 0.8}, 10},
    // nose
    {"pronasale", {0, -2, 2.5}, 10},
    {"ibug68_28", {0, 0, 2.5}, 9},
    {"alare_R", {-1.2, 0, 0}, 8},
    {"alare_L", {1.2, 0, 0}, 8},
    // cheekbones and brows
    {"cheek_R", {-1, 2, -1.5}, 16},
    {"cheek_L", {1, 2, -1.5}, 16},
    {"ibug68_19", {0, 1, 2}, 13},
    {"ibug68_24", {0, 1, 2}, 13},
    // differences between the sides
    {"pronasale", {1.0, 0, 0}, 12},
    {"cheilion_R", {0, -1.0, 0}, 12},
    {"pogonion", {-1.5, 0, 0}, 20},
    {"cheek_R", {-0.5, 0, 1.2}, 16},
    {"ibug68_24", {0, 1.2, 0}, 12},
};

}  // namespace

anatomy::EmbeddedFace second_face() {
  anatomy::EmbeddedFace face = anatomy::embedded_face();
  const Points moved = face.mesh.points + displacement(kShape, face.landmarks, face.mesh.points);
  Points landmarks(Eigen::Index(face.landmarks.size()), 3);
  Eigen::Index row = 0;
  for (const auto& [name, at] : face.landmarks) landmarks.row(row++) = at.transpose();
  landmarks += displacement(kShape, face.landmarks, landmarks);
  row = 0;
  for (auto& [name, at] : face.landmarks)
    at = landmarks.row(row++).transpose().cwiseProduct(kProportions);
  face.mesh.points = moved * kProportions.asDiagonal();
  return face;
}

}  // namespace hyperex::sample
