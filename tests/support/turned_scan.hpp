// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scans in all orientations, and the errors of landmarks found on them.
#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"

namespace hyperex::test {

/// One of the 24 rotations that map the axes onto each other, 0 to 23.
inline Eigen::Matrix3d right_angle_turn(int k) {
  const int axis = k / 4 % 3;
  Eigen::Matrix3d axes;
  axes.col(2) = Vec3::Unit(axis) * (k < 12 ? 1 : -1);
  axes.col(0) = Vec3::Unit((axis + 1) % 3);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes * Eigen::AngleAxisd(k % 4 * std::numbers::pi / 2, Vec3::UnitZ());
}

/// One of these rotations, followed by 20 degrees about an oblique axis.
inline Eigen::Matrix3d slanting_turn(int k) {
  return Eigen::AngleAxisd(20 * std::numbers::pi / 180, Vec3(1, 2, 3).normalized()) *
         right_angle_turn(k);
}

inline TriMesh turned(TriMesh mesh, const Eigen::Matrix3d& rotation) {
  mesh.points = mesh.points * rotation.transpose();
  return mesh;
}

/// Distances (mm) of the landmarks that are in both sets, sorted; `truth` is rotated by `rotation`
/// first. `first_ibug` > 0: only the iBUG points from that number on (17: the 51 inner ones).
inline std::vector<double> errors_mm(const io::Landmarks& found, const io::Landmarks& truth,
                                     const Eigen::Matrix3d& rotation, int first_ibug) {
  std::vector<double> errors;
  for (const auto& [name, at] : truth) {
    if (first_ibug > 0 && (!name.starts_with("ibug68_") || std::stoi(name.substr(7)) < first_ibug))
      continue;
    if (found.contains(name)) errors.push_back(1e3 * (found.at(name) - rotation * at).norm());
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace hyperex::test
