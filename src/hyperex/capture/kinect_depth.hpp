// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core/mat.hpp>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// Nominal dimensions of a Kinect, for drivers that return raw depth only (Debian's fakenect). The
/// values are those that libfreenect's registration uses for a device that reports none.
struct NominalKinect {
  static constexpr double emitter_m = 0.075;   ///< from projector to depth camera
  static constexpr double baseline_m = 0.023;  ///< from depth camera to colour camera, along x
  static constexpr double reference_m = 1.2;   ///< distance of the reference plane
  /// Width of one of the sensor's 1280 columns on that plane.
  static constexpr double pixel_m = 0.001042;
  /// Focal length in pixels of 640 columns: 575.8.
  static constexpr double depth_f_px = reference_m / (2 * pixel_m);
};

/// Depth in metres of a raw 11-bit value. With the shift d = ((raw - 800) / 4 - 0.375) pixel of the
/// projected speckles on the reference plane, z = reference (1 + d / (emitter - d)). Returns 0 for
/// 2047 (no reading), for values that would give an infinite or negative depth, and beyond 10 m.
double kinect_depth_m(int raw);

/// Converts raw values (CV_16UC1, 640 x 480) to metres (CV_32FC1) in the picture of the `colour`
/// camera. Every reading is back-projected through the depth camera and projected into the colour
/// camera; where several fall on one pixel, the nearest is kept. On a real device, the result is
/// off by some pixels, because each device differs a little from the nominal one.
cv::Mat registered_nominally(const cv::Mat& raw, const Intrinsics& colour);

}  // namespace hyperex::capture
