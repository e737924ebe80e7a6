// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/asymmetry_picture.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::run {

render::Image draw_asymmetry(const TriMesh& moved, const Eigen::VectorXf& map_mm,
                             const metrics::Asymmetry& asymmetry, const io::Landmarks& landmarks,
                             const std::string& title, const std::string& note) {
  // A smaller range of colours would show noise and errors of the mesh on a symmetric face.
  constexpr double least_top_mm = 5;
  // A few vertices at a torn or cut place must not set the scale.
  constexpr double shown_share = 0.99;
  std::vector<float> values;
  Points framed(static_cast<Eigen::Index>(asymmetry.face.size()), 3);
  for (Eigen::Index i = 0; i < framed.rows(); ++i) {
    const int v = asymmetry.face[static_cast<std::size_t>(i)];
    framed.row(i) = moved.points.row(v);
    values.push_back(map_mm[v]);
  }
  double top = least_top_mm;
  if (!values.empty()) {
    const auto at =
        values.begin() + static_cast<long>(shown_share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    top = std::max(top, static_cast<double>(*at));
  }
  if (framed.rows() == 0) framed = moved.points;
  const auto frame = face::face_frame_of_corners(landmarks);
  const Eigen::Matrix3d scan_from_face =
      frame ? Eigen::Matrix3d(frame->face_from_scan().transpose()) : Eigen::Matrix3d::Identity();
  const render::Surface surface{.mesh = moved, .scalar = map_mm, .range = {0, top}};
  const render::RenderOptions size{.width_px = 380, .height_px = 480};
  const double aspect = static_cast<double>(size.width_px) / size.height_px;
  Vec3 from_right = render::three_quarter_view();
  from_right.x() *= -1;
  render::ContactSheet sheet{.title = title, .note = note, .columns = 3};
  const std::array views{std::pair{from_right, "right side"},
                         std::pair{render::front_view(), "front"},
                         std::pair{render::three_quarter_view(), "left side"}};
  sheet.pictures.resize(views.size());
  run_each(views.size(), [&](std::size_t i) {
    const auto& [view, caption] = views[i];
    const render::Camera camera =
        render::framing(framed, scan_from_face * view, aspect, scan_from_face.col(1));
    sheet.pictures[i] = {render::render({surface}, camera, size), caption,
                         render::side_marks(camera, scan_from_face.col(0))};
  });
  float most = 0;
  for (Eigen::Index i = 0; i < map_mm.size(); ++i)
    if (map_mm[i] > most) most = map_mm[i];
  sheet.bar =
      render::ColourBar{{0, top}, "asymmetry (mm)", static_cast<double>(most) > top * 1.001};
  return render::contact_sheet(sheet);
}

}  // namespace hyperex::run
