// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace hyperex::tracking {

/// A rotated square region of a picture, in pixels, with pixel centres at integers.
struct FaceRegion {
  double x = 0, y = 0;   ///< centre
  double side_px = 0;    ///< > 0
  double angle_rad = 0;  ///< from the picture's x axis to the square's, clockwise as seen (y down)

  /// Picture coordinates of the point (u, v) of the square: (0, 0) is its upper left corner, (1, 1)
  /// its lower right one.
  cv::Point2d picture_from_square(double u, double v) const;
};

/// Resamples the square to `patch_px` x `patch_px` pixels, bilinearly, with averaging if the
/// picture has the higher resolution. Outside the picture, its border pixels are repeated, or black
/// is used if `black_outside` is set. `scratch` and `patch` are reused between calls.
void cut_out(const cv::Mat& picture, const FaceRegion& region, int patch_px, bool black_outside,
             cv::Mat& scratch, cv::Mat& patch);

}  // namespace hyperex::tracking
