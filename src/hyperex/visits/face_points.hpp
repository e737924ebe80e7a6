// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::visits {

/// The points of a face that the measures use. R and L are the subject's own sides.
enum class FacePoint {
  corner_R,
  corner_L,
  inner_upper_lip,
  inner_lower_lip,
  upper_lip,
  subnasale,
  upper_lid_R,
  upper_lid_L,
  lower_lid_R,
  lower_lid_L,
  brow_R,
  brow_L,
  outer_eye_R,
  outer_eye_L,
  alare_R,
  alare_L,
  crista_philtri_R,
  crista_philtri_L
};
inline constexpr std::size_t kFacePoints = 18;

enum class Side { right, left };

/// The point of that side, of a pair whose right point is given.
constexpr FacePoint of_side(FacePoint right, Side side) {
  return FacePoint(int(right) + int(side == Side::left));
}

template <typename T>
using ByFacePoint = std::array<T, kFacePoints>;

template <typename T>
T& at(ByFacePoint<T>& values, FacePoint point) {
  return values[std::size_t(point)];
}
template <typename T>
const T& at(const ByFacePoint<T>& values, FacePoint point) {
  return values[std::size_t(point)];
}

/// For each point, the columns of the motion whose mean it is: its anatomical landmark or its
/// iBUG points; empty if the motion has neither.
ByFacePoint<std::vector<int>> face_points_of(const motion::Motion& motion);

/// The mean of these columns over time, N x 3, m. NaN where one of them is not measured.
Points track_of(const motion::Motion& motion, const std::vector<int>& columns);

}  // namespace hyperex::visits
