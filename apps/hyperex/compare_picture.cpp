// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::cli {
namespace {

// The next of 1, 1.5, 2, 3, 4, 5, 6, 8, 10 times a power of ten.
double rounded_up(double value) {
  if (!(value > 1e-9) || !std::isfinite(value)) return 0.1;
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (factor * decade >= value) return factor * decade;
  return 10 * decade;
}

// Distance in millimetres for every vertex. A vertex without one takes the mean of its neighbours.
Eigen::VectorXf scalar_of(const ComparePicture& picture) {
  const TriMesh& mesh = picture.surface;
  const Eigen::Index scored = picture.distance_m.size();
  Eigen::VectorXf scalar =
      Eigen::VectorXf::Constant(mesh.points.rows(), std::numeric_limits<float>::quiet_NaN());
  scalar.head(scored) = (1e3 * picture.distance_m).cast<float>();
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(mesh.points.rows()), count = sum;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        if (mesh.triangles(f, k) >= scored && mesh.triangles(f, j) < scored) {
          sum[mesh.triangles(f, k)] += scalar[mesh.triangles(f, j)];
          ++count[mesh.triangles(f, k)];
        }
  for (Eigen::Index i = scored; i < scalar.size(); ++i)
    if (count[i] > 0) scalar[i] = sum[i] / count[i];
  return scalar;
}

}  // namespace

render::Image draw(const ComparePicture& picture) {
  const TriMesh& mesh = picture.surface;
  Points framed = mesh.points;
  if (!picture.framed.empty()) {
    framed.resize(static_cast<Eigen::Index>(picture.framed.size()), 3);
    for (size_t i = 0; i < picture.framed.size(); ++i)
      framed.row(i) = mesh.points.row(picture.framed[i]);
  }
  const double top = rounded_up(picture.top_mm);
  const Eigen::VectorXf scalar = scalar_of(picture);
  const render::Surface surface{.mesh = mesh, .scalar = scalar, .range = {0, top}};
  const render::RenderOptions size{.width_px = 520, .height_px = 640};
  render::ContactSheet sheet{.title = picture.title, .note = picture.note};
  const Eigen::Matrix3d scan_from_face = picture.face_from_scan.transpose();
  for (const auto& [view, caption] : {std::pair{render::front_view(), "front"},
                                      std::pair{render::three_quarter_view(), "three-quarter"}}) {
    const render::Camera camera =
        render::framing(framed, scan_from_face * view,
                        static_cast<double>(size.width_px) / size.height_px, scan_from_face.col(1));
    sheet.pictures.push_back({render::render({surface}, camera, size), caption,
                              render::side_marks(camera, scan_from_face.col(0))});
  }
  sheet.bar = render::ColourBar{{0, top}, "distance (mm)", scalar.maxCoeff() > top};
  return render::contact_sheet(sheet);
}

}  // namespace hyperex::cli
