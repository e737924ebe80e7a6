// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/asymmetry_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/report/border_fade.hpp"

namespace hyperex::run {
namespace {

/// No values where the skin ends, and where a counterpart lies there: a scan's two edges are not
/// each other's mirror image, and where one is held and the other moves with the jaw, the map would
/// show that.
Eigen::VectorXf inside_border(const TriMesh& skin, Eigen::VectorXf map_mm,
                              const metrics::Counterparts& pairs) {
  const Eigen::VectorXf fade = report::border_fade(skin);
  for (Eigen::Index v = 0; v < map_mm.size(); ++v) {
    const auto i = static_cast<std::size_t>(v);
    bool inside = fade[v] >= 1;
    if (pairs.found[i])
      for (const int other : pairs.vertices[i]) inside = inside && fade[other] >= 1;
    if (!inside) map_mm[v] = std::numeric_limits<float>::quiet_NaN();
  }
  return map_mm;
}

}  // namespace

render::Image draw_asymmetry(const TriMesh& moved, const Eigen::VectorXf& whole_map_mm,
                             const metrics::Asymmetry& asymmetry, const io::Landmarks& landmarks,
                             const std::string& title, const std::string& note,
                             const BackingSurfaces* behind) {
  // A smaller range of colours would show noise and errors of the mesh on a symmetric face.
  constexpr double least_top_mm = 5;
  // A few vertices at a torn or cut place must not set the scale.
  constexpr double shown_share = 0.99;
  const Eigen::VectorXf map_mm = inside_border(moved, whole_map_mm, asymmetry.pairs);
  std::vector<float> values;
  Points framed(static_cast<Eigen::Index>(asymmetry.face.size()), 3);
  for (Eigen::Index i = 0; i < framed.rows(); ++i) {
    const int v = asymmetry.face[static_cast<std::size_t>(i)];
    framed.row(i) = moved.points.row(v);
    if (!std::isnan(map_mm[v])) values.push_back(map_mm[v]);
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
  render::ContactSheet sheet{
      .title = title + " (both sides compared, so it does not show which one is weak)",
      .note = note,
      .columns = 3};
  const std::array views{
      std::pair{from_right, "right side"},
      std::pair{render::front_view(), "front; grey: no counterpart, or at the edge of the skin"},
      std::pair{render::three_quarter_view(), "left side"}};
  sheet.pictures.resize(views.size());
  run_each(views.size(), [&](std::size_t i) {
    const auto& [view, caption] = views[i];
    const render::Camera camera =
        render::framing(framed, scan_from_face * view, aspect, scan_from_face.col(1));
    const std::vector<render::Surface> all = behind ? behind->with(surface) : std::vector{surface};
    sheet.pictures[i] = {render::render(all, camera, size), caption,
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
