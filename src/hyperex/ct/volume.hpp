// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Grey values on a grid of parallel planes. The grid may be turned or sheared: its three steps are
// any vectors.
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::ct {

/// A point of DICOM's patient frame (x to the left, y to the back, z up) in Hyperex's frame of a
/// face (x to the left, y up, z forward). Rows: face_from_patient, a rotation.
Eigen::Matrix3d face_from_patient();

/// Hounsfield units at the points origin_m + step_m * (i, j, k), in the frame of a face.
struct Volume {
  std::array<int, 3> size{};  ///< number of values along each index
  Vec3 origin_m = Vec3::Zero();
  /// Columns: the way from one value to the next along each index.
  Eigen::Matrix3d step_m = Eigen::Matrix3d::Identity();
  std::vector<float> hu;  ///< the first index varies fastest

  std::size_t count() const { return std::size_t(size[0]) * size[1] * size[2]; }
  std::size_t at(int i, int j, int k) const {
    return (std::size_t(k) * size[1] + j) * size[0] + std::size_t(i);
  }
  Vec3 place(double i, double j, double k) const { return origin_m + step_m * Vec3(i, j, k); }
  Vec3 index_of(const Vec3& place_m) const { return step_m.inverse() * (place_m - origin_m); }
  Vec3 spacing_m() const { return step_m.colwise().norm().transpose(); }
  double voxel_m3() const;
  /// Trilinear; NaN outside the grid.
  double sample(const Vec3& place_m) const;
  /// The index that runs most nearly upwards in the patient, 0 to 2.
  int upward_axis() const;
  /// Whether a scanner may give this grid: steps of 0.01 to 100 mm that do not lie in a plane, no
  /// more than 5 m in all, within 100 m of the origin.
  bool is_possible() const;
};

/// One flag or number per value of a Volume, in its order.
using Mask = std::vector<std::uint8_t>;

}  // namespace hyperex::ct
