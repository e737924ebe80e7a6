// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/surgery_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/plane_section.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/run/backing_surfaces.hpp"
#include "hyperex/run/face_box.hpp"

namespace hyperex::run {
namespace {

/// What the pictures of surgery share: the skin in the face frame.
struct BeforeAndAfter {
  const Results& base;
  const simulate::Performance &before, &after;
  face::FaceFrame frame = face::face_frame(base.inputs.landmarks);
  FaceBox box = face_box(base.inputs.landmarks, frame);
  std::array<std::size_t, 2> frames{0, std::size_t(before.peak_frame)};  ///< rest, expression

  TriMesh skin(const simulate::Performance& of, std::size_t at) const {
    return {frame.local_points(before.skin_rest.points + of.skin_displacement_m[at].cast<double>()),
            before.skin_rest.triangles};
  }
};

constexpr render::RenderOptions kSize{.width_px = 300, .height_px = 380};
constexpr render::Colour kBefore = render::palette::faint_ink, kAfter = render::palette::driven;

/// From the front and in profile, at the same scale.
std::array<render::Camera, 2> cameras_on(const BeforeAndAfter& both) {
  const Points rest = both.frame.local_points(both.before.skin_rest.points);
  std::vector<Vec3> seen;
  for (const std::size_t f : both.frames)
    for (const simulate::Performance* p : {&both.before, &both.after}) {
      const TriMesh skin = both.skin(*p, f);
      for (Eigen::Index v = 0; v < rest.rows(); ++v)
        if (both.box.holds(rest.row(v))) seen.emplace_back(skin.points.row(v));
    }
  Points framed(Eigen::Index(seen.size()), 3);
  for (std::size_t i = 0; i < seen.size(); ++i) framed.row(Eigen::Index(i)) = seen[i].transpose();
  const double aspect = double(kSize.width_px) / kSize.height_px;
  std::array cameras{render::framing(framed, render::front_view(), aspect),
                     render::framing(framed, Vec3::UnitX(), aspect)};
  cameras[0].height_m = cameras[1].height_m = std::max(cameras[0].height_m, cameras[1].height_m);
  return cameras;
}

/// The lines in which a plane cuts the skin at rest, before and after surgery.
struct Outlines {
  Points before, after;
};

void draw_outlines(render::Canvas& canvas, const render::Camera& camera, const Outlines& lines) {
  for (const auto& [segments, colour] : {std::pair{&lines.before, kBefore}, {&lines.after, kAfter}})
    for (Eigen::Index i = 0; i + 1 < segments->rows(); i += 2) {
      const auto [a, b] =
          std::pair{render::project(camera, kSize.width_px, kSize.height_px, segments->row(i)),
                    render::project(camera, kSize.width_px, kSize.height_px, segments->row(i + 1))};
      canvas.line(a.x, a.y, b.x, b.y, colour, 1.6);
    }
}

/// The named landmarks of the midline that the variant has.
struct NamedPlace {
  const char* words;
  double moved_mm;
  Vec3 place;  ///< after surgery, at rest, in the face frame
};

std::vector<NamedPlace> named_places(const BeforeAndAfter& both,
                                     const std::vector<metrics::SoftTissueMove>& moves) {
  std::vector<NamedPlace> out;
  const motion::Motion& then = both.after.landmarks;
  for (const auto& [name, words] : kSurgeryLandmarks)
    for (const metrics::SoftTissueMove& move : moves)
      if (const int row = then.index_of(name); row >= 0 && move.landmark == name)
        out.push_back(
            {words, move.at_rest.norm(), both.frame.local(then.positions[0].row(row).transpose())});
  return out;
}

/// The midline of the lower face at rest, before and after surgery, in profile, with the distance
/// by which surgery moves each landmark on it.
render::Image draw_midline(const BeforeAndAfter& both, const std::vector<NamedPlace>& places) {
  constexpr double kText_px = 12, kLine_px = 15, kWords_px = 158;
  constexpr double kAbove_m = 0.045, kBelow_m = 0.035;
  double low_m = 1e9, high_m = -1e9, front_m = -1e9;
  for (const NamedPlace& one : places) {
    low_m = std::min(low_m, one.place.y()), high_m = std::max(high_m, one.place.y());
    front_m = std::max(front_m, one.place.z());
  }
  render::Camera camera{.to_viewer = Vec3::UnitX(),
                        .height_m = high_m - low_m + kAbove_m + kBelow_m};
  // The words stand before the face, on the left of the picture.
  const double m_per_px = camera.height_m / kSize.height_px;
  camera.target = {0, (high_m + kAbove_m + low_m - kBelow_m) / 2,
                   front_m - (0.5 * kSize.width_px - kWords_px) * m_per_px};
  render::Canvas canvas(kSize.width_px, kSize.height_px);
  const auto midline_of = [&](const simulate::Performance& of) {
    return plane_section(both.skin(of, 0), Vec3::Zero(), Vec3::UnitX());
  };
  draw_outlines(canvas, camera, {midline_of(both.before), midline_of(both.after)});
  double free_below_px = kSize.height_px - 6;
  for (const NamedPlace& one : places) {
    const render::Projected at =
        render::project(camera, kSize.width_px, kSize.height_px, one.place);
    const double y = std::min(at.y + kText_px / 3, free_below_px);
    const double width = canvas.text(4, y, fmt::format("{} {:.1f} mm", one.words, one.moved_mm),
                                     {.size_px = kText_px});
    canvas.line(4 + width + 4, y - kText_px / 3, at.x, at.y, kBefore, 0.8);
    canvas.disc(at.x, at.y, 2.5, kAfter);
    free_below_px = y - kLine_px;
  }
  return canvas.image();
}

/// The outline of the face at the height of its greatest change at rest, from below.
render::Image draw_level(const BeforeAndAfter& both) {
  const TriMesh before = both.skin(both.before, 0), after = both.skin(both.after, 0);
  Eigen::Index most = 0;
  const double most_m = (after.points - before.points).rowwise().norm().maxCoeff(&most);
  const Vec3 at = after.points.row(most);
  const Outlines lines{plane_section(before, at, Vec3::UnitY()),
                       plane_section(after, at, Vec3::UnitY())};
  const double aspect = double(kSize.width_px) / kSize.height_px;
  const render::Camera camera =
      render::framing(points_within(both.box, lines.after), -Vec3::UnitY(), aspect, Vec3::UnitZ());
  render::Canvas canvas(kSize.width_px, kSize.height_px);
  draw_outlines(canvas, camera, lines);
  const render::Projected place = render::project(camera, kSize.width_px, kSize.height_px, at);
  canvas.disc(place.x, place.y, 2.5, kAfter);
  canvas.text(0.5 * kSize.width_px, 20, fmt::format("at the dot {:.1f} mm", 1e3 * most_m),
              {.size_px = 12, .align = render::Align::centre});
  return canvas.image();
}

/// The midline where surgery moves its landmarks, else the level at which the face changes most.
render::SheetPicture draw_change(const BeforeAndAfter& both,
                                 const std::vector<metrics::SoftTissueMove>& moves) {
  const double seen_mm = 0.5 * metrics::greatest_change_at_rest_mm(both.before, both.after);
  const std::vector<NamedPlace> places = named_places(both, moves);
  if (std::any_of(places.begin(), places.end(),
                  [&](const NamedPlace& one) { return one.moved_mm > seen_mm; }))
    return {draw_midline(both, places), "midline at rest: before grey, after red"};
  return {draw_level(both),
          "level at rest, from below: before grey, after red",
          {.at_left = "R", .at_right = "L"}};
}

/// The face at rest from the front, coloured by how far surgery moves it.
render::SheetPicture draw_change_at_rest(const BeforeAndAfter& both, const render::Camera& front,
                                         const render::Range& range_mm,
                                         const BackingSurfaces& behind, const TriMesh& skin) {
  const PointsF change = both.after.skin_displacement_m[0] - both.before.skin_displacement_m[0];
  return {
      render::render(
          behind.with({.mesh = skin, .scalar = 1e3F * change.rowwise().norm(), .range = range_mm}),
          front, kSize),
      "change at rest", render::side_marks(front)};
}

}  // namespace

void draw_surgery(const Results& base, const session::VariantRun& run,
                  const std::vector<metrics::SoftTissueMove>& moves,
                  const std::filesystem::path& file) {
  const BeforeAndAfter both{base, base.simulation.performance, run.simulation.performance};
  const std::array cameras = cameras_on(both);
  const report::FaceBacking backing =
      backing_in_frame(both.before.skin_rest, base.inputs.landmarks, base.teeth, both.frame);
  const render::Range range_mm{
      0, std::max(0.1, metrics::greatest_change_at_rest_mm(both.before, both.after))};
  render::ContactSheet sheet;
  sheet.title = run.scene.title;
  sheet.note = fmt::format("before and after surgery: at rest, and at {:.2f} s",
                           both.before.frame_time_s[both.frames[1]]);
  sheet.columns = 5;
  sheet.bar = render::ColourBar{range_mm, "change (mm)"};
  sheet.pictures.resize(10);
  run_each(sheet.pictures.size(), [&](std::size_t cell) {
    const std::size_t row = cell / 5, view = cell % 5 / 2;
    const bool change = view == 2, later = change || cell % 5 % 2 == 1;
    if (change && row == 1) {
      sheet.pictures[cell] = draw_change(both, moves);
      return;
    }
    const simulate::Performance& p = later ? both.after : both.before;
    const TriMesh skin = both.skin(p, both.frames[row]);
    const BackingSurfaces behind(backing, both.frame, skin.points, base.teeth,
                                 p.jaw_now_from_rest[both.frames[row]], p.upper_teeth_now_from_rest,
                                 gaze_in(p, both.frames[row]));
    sheet.pictures[cell] =
        change ? draw_change_at_rest(both, cameras[0], range_mm, behind, skin)
               : render::SheetPicture{
                     render::render(behind.with({.mesh = skin}), cameras[view], kSize),
                     fmt::format("{}, {}", later ? "after" : "before",
                                 row == 0 ? "at rest" : "expression"),
                     render::side_marks(cameras[view])};
  });
  render::write_png(file, render::contact_sheet(sheet));
}

}  // namespace hyperex::run
