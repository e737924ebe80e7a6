// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "hyperex/visits/face_points.hpp"

namespace hyperex::visits {

/// What the measures of one recording are computed from: the points at rest and at the peak of the
/// expression.
struct FaceState {
  ByFacePoint<Vec3> rest, peak;  ///< m, without head pose; NaN where not measured
  /// Rows: the directions to the subject's left, up and forward, the same on the skull at every
  /// visit; NaN if the points do not determine them.
  Eigen::Matrix3d axes;
  /// The directions of the corners (right, left) in the first visit, in these axes; NaN where they
  /// moved less than kLeastMovement_m.
  std::array<Vec3, 2> first_direction;
  std::array<double, 2> first_excursion_m = {0, 0};  ///< how far they moved that way
};

struct Measure {
  std::string key;    ///< "corner_excursion"
  std::string words;  ///< "Corner of the mouth: excursion"
  std::string side;   ///< "R", "L" or empty
  std::string unit;   ///< "mm", "degrees" or "%"
  /// NaN if a point that it needs is not measured, or if the movement is too small to have a
  /// direction. Empty for a measure of scans.
  std::function<double(const FaceState&)> value;
};

/// A movement shorter than this has no direction, m.
inline constexpr double kLeastMovement_m = 2e-3;

/// All measures, R before L. In a recording's result the same order holds.
///  corner_excursion  distance of the corner of the mouth from rest
///  corner_up, corner_outward, corner_forward  its parts; outward: away from the midline
///  smile_angle  of its direction seen from the front: 0 outward, 90 up
///  corner_along_first  its part along the direction that it had at the first visit
///  corner_follows  its part along the mirrored way that the other corner had at the first visit,
///                  in % of that way. A corner that is dragged the other way has a negative value.
///                  It changes with this corner's motion alone.
///  corner_difference  excursion of the right less that of the left corner
///  stretch_difference  100 (xi_R - xi_L), where xi is the sum of the relative changes of four
///                      distances from the corner of the mouth: S(t) is the logarithm of its size
///                      (metrics/symmetry.hpp)
///  lip_opening  distance between the inner lips at the peak
///  brow_raise  upward movement of the brow
///  eye_opening  distance between the lids at rest
///  eye_narrowing  by how much that is less at the peak: in a smile, synkinesis of the lids
///  philtrum_rest, philtrum_peak  how far the upper lip's middle lies left of the base of the nose
///  corner_height  how much higher the right corner is than the left, at rest
const std::vector<Measure>& measures();

}  // namespace hyperex::visits
