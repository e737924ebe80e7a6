// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/slice_picture.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/plane_section.hpp"
#include "hyperex/render/canvas.hpp"

namespace hyperex::ct {
namespace {

constexpr double kBlack_hu = -500, kWhite_hu = 1200;
constexpr double kLine_px = 1.6;

}  // namespace

render::Image slice_picture(const Volume& volume, const SlicePlane& plane,
                            const std::vector<Contour>& contours, double pixels_per_m) {
  render::Image image(int(plane.width_m * pixels_per_m), int(plane.height_m * pixels_per_m),
                      {0, 0, 0});
  tbb::parallel_for(0, image.height, [&](int row) {
    for (int column = 0; column < image.width; ++column) {
      const Vec3 p = plane.middle +
                     ((column + 0.5) / pixels_per_m - plane.width_m / 2) * plane.right -
                     ((row + 0.5) / pixels_per_m - plane.height_m / 2) * plane.up;
      const double hu = volume.sample(p);
      if (std::isnan(hu)) continue;
      const double share = std::clamp((hu - kBlack_hu) / (kWhite_hu - kBlack_hu), 0.0, 1.0);
      std::fill_n(image.pixel(column, row), 3, std::uint8_t(std::lround(255 * share)));
    }
  });
  render::Canvas canvas(image);
  for (const Contour& contour : contours) {
    const Points ends = plane_section(contour.mesh, plane.middle, plane.right.cross(plane.up));
    const auto x = [&](Eigen::Index i) {
      return ((ends.row(i).transpose() - plane.middle).dot(plane.right) + plane.width_m / 2) *
             pixels_per_m;
    };
    const auto y = [&](Eigen::Index i) {
      return (plane.height_m / 2 - (ends.row(i).transpose() - plane.middle).dot(plane.up)) *
             pixels_per_m;
    };
    for (Eigen::Index i = 0; i + 1 < ends.rows(); i += 2)
      canvas.line(x(i), y(i), x(i + 1), y(i + 1), contour.colour, kLine_px);
  }
  return canvas.image();
}

}  // namespace hyperex::ct
