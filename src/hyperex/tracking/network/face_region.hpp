// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace hyperex::tracking {

/// A square of a picture, turned: pixels, pixel centres at integers.
struct FaceRegion {
  double x = 0, y = 0;   ///< centre
  double side_px = 0;    ///< > 0
  double angle_rad = 0;  ///< from the picture's x axis to the square's, clockwise as seen (y down)

  /// Picture coordinates of a place in the square, (0, 0) its upper left corner, (1, 1) the lower
  /// right one.
  cv::Point2d picture_from_square(double u, double v) const;
};

/// Samples the square to `patch_px` x `patch_px` pixels, bilinear, averaged where the picture is
/// finer than the patch; outside the picture its border goes on, or `outside` is black.
/// `scratch` and `patch` are used again from call to call.
void cut_out(const cv::Mat& picture, const FaceRegion& region, int patch_px, bool black_outside,
             cv::Mat& scratch, cv::Mat& patch);

}  // namespace hyperex::tracking
