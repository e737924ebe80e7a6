// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/slice_picture.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hyperex/render/canvas.hpp"

namespace hyperex::ct {
namespace {

constexpr double kBlack_hu = -500, kWhite_hu = 1200;
constexpr double kLine_px = 1.6;

}  // namespace

Points cut_by_plane(const TriMesh& mesh, const Vec3& middle, const Vec3& normal) {
  const Eigen::VectorXd above = (mesh.points.rowwise() - middle.transpose()) * normal;
  std::vector<Vec3> ends;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    std::array<Vec3, 2> cut;
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
      if ((above[a] < 0) == (above[b] < 0)) continue;
      const double share = above[a] / (above[a] - above[b]);
      cut[std::min<std::size_t>(count++, 1)] =
          (1 - share) * mesh.points.row(a).transpose() + share * mesh.points.row(b).transpose();
    }
    if (count == 2) ends.insert(ends.end(), cut.begin(), cut.end());
  }
  Points out(Eigen::Index(ends.size()), 3);
  for (std::size_t i = 0; i < ends.size(); ++i) out.row(Eigen::Index(i)) = ends[i].transpose();
  return out;
}

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
    const Points ends = cut_by_plane(contour.mesh, plane.middle, plane.right.cross(plane.up));
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
