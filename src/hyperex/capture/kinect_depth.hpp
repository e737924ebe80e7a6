// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core/mat.hpp>

#include "hyperex/capture/frame.hpp"

namespace hyperex::capture {

/// The nominal Kinect, for drivers that hand out raw depth only (Debian's fakenect). The lengths
/// are those that libfreenect's registration takes for a device that reports none.
struct NominalKinect {
  static constexpr double emitter_m = 0.075;   ///< projector to depth camera
  static constexpr double baseline_m = 0.023;  ///< depth camera to colour camera, along x
  static constexpr double reference_m = 1.2;   ///< distance of the reference plane
  static constexpr double pixel_m = 0.001042;  ///< of the sensor's 1280 columns, on that plane
  static constexpr double depth_f_px = reference_m / (2 * pixel_m);  ///< at 640 columns: 575.8
};

/// Metres of a raw 11-bit value: d = ((raw - 800) / 4 - 0.375) pixel is the speckle's shift on the
/// reference plane, z = reference (1 + d / (emitter - d)). 0 for 2047 and what lies behind
/// infinity.
double kinect_depth_m(int raw);

/// CV_16UC1 of raw values, 640 x 480 -> CV_32FC1 in metres in the picture of the `colour` camera:
/// every reading goes through the pinholes of both cameras, the nearer one wins a pixel.
/// Good to some pixels on a real device, as each differs a little from the nominal one.
cv::Mat registered_nominally(const cv::Mat& raw, const Intrinsics& colour);

}  // namespace hyperex::capture
