// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex::anatomy {

/// The embedded face made wider, longer, bent and rotated: another person with known landmarks.
inline EmbeddedFace another_face(double turned_rad) {
  EmbeddedFace face = embedded_face();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(turned_rad, Vec3(0.2, 1, -0.4).normalized()).toRotationMatrix();
  const auto change = [&](const Vec3& p) -> Vec3 {
    return turn * Vec3(1.06 * p.x(), 0.96 * p.y() + 0.3 * p.x() * p.x(), 0.95 * p.z()) +
           Vec3(0.1, -0.2, 0.3);
  };
  for (Eigen::Index v = 0; v < face.mesh.points.rows(); ++v)
    face.mesh.points.row(v) = change(face.mesh.points.row(v)).transpose();
  for (auto& [name, p] : face.landmarks) p = change(p);
  return face;
}

}  // namespace hyperex::anatomy
