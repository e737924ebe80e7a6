// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/teeth.hpp"

#include "hyperex/geometry/grid_distance.hpp"

namespace hyperex::anatomy {

std::shared_ptr<const SignedDistance> distance_to(const JawTeeth& jaw) {
  if (jaw.empty()) return nullptr;
  TriMesh both;
  both.points.resize(jaw.crowns.points.rows() + jaw.gum.points.rows(), 3);
  both.points << jaw.crowns.points, jaw.gum.points;
  both.triangles.resize(jaw.crowns.triangles.rows() + jaw.gum.triangles.rows(), 3);
  both.triangles << jaw.crowns.triangles,
      (jaw.gum.triangles.array() + static_cast<int>(jaw.crowns.points.rows())).matrix();
  return std::make_shared<GridDistance>(both);
}

}  // namespace hyperex::anatomy
