// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/face_region.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace hyperex::tracking {

cv::Point2d FaceRegion::picture_from_square(double u, double v) const {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const double right = (u - 0.5) * side_px, down = (v - 0.5) * side_px;
  return {x + c * right - s * down, y + s * right + c * down};
}

void cut_out(const cv::Mat& picture, const FaceRegion& region, int patch_px, bool black_outside,
             cv::Mat& scratch, cv::Mat& patch) {
  // A bilinear sample covers two pixels. If the picture is finer than that, it is sampled more
  // densely and averaged.
  constexpr double bilinear_reach_px = 1.5;
  const int finer = std::max(1, int(std::lround(region.side_px / patch_px / bilinear_reach_px)));
  const int size = patch_px * finer;
  const cv::Point2d origin = region.picture_from_square(0.5 / size, 0.5 / size);
  const double c = std::cos(region.angle_rad) * region.side_px / size;
  const double s = std::sin(region.angle_rad) * region.side_px / size;
  const cv::Matx23d picture_from_patch(c, -s, origin.x, s, c, origin.y);
  cv::warpAffine(picture, finer == 1 ? patch : scratch, picture_from_patch, {size, size},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 black_outside ? cv::BORDER_CONSTANT : cv::BORDER_REPLICATE);
  if (finer > 1) cv::resize(scratch, patch, {patch_px, patch_px}, 0, 0, cv::INTER_AREA);
}

}  // namespace hyperex::tracking
