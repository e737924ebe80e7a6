// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/variants_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/metrics/curve_spread.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/render/time_plot.hpp"
#include "hyperex/run/backing_surfaces.hpp"
#include "hyperex/run/face_box.hpp"

namespace hyperex::run {
namespace {

/// Names with their colours, in as many lines as they need; returns the height.
double draw_legend(render::Canvas& canvas, double left, double right, double y,
                   const std::vector<render::PlotCurve>& curves) {
  constexpr double line_px = 20, swatch_px = 22, gap_px = 18;
  double x = left, at = y;
  for (const render::PlotCurve& curve : curves) {
    const render::TextStyle style{.size_px = 13};
    const double width = swatch_px + canvas.text_width(curve.name, style);
    if (x > left && x + width > right) {
      x = left;
      at += line_px;
    }
    canvas.rectangle(x, at - 6, swatch_px - 6, 3, curve.colour);
    canvas.text(x + swatch_px, at, curve.name, style);
    x += width + gap_px;
  }
  return at + line_px - y;
}

/// The end of the colour bar, mm, and whether larger distances take its last colour.
struct ColourTop {
  double mm = 0;
  bool capped = false;
};

/// One variant that moves much more than the others must not make them all look alike.
ColourTop colour_top(const std::vector<metrics::VariantComparison>& compared) {
  std::vector<double> each;
  for (const auto& one : compared) each.push_back(one.greatest_distance_mm);
  std::sort(each.begin(), each.end());
  ColourTop top{std::max(0.0, each.back())};
  const double middle = each[each.size() / 2 - (each.size() % 2 == 0 ? 1 : 0)];
  top.capped = top.mm > 4 * middle && middle > 0.1;
  if (top.capped) top.mm = 2 * middle;
  top.mm = std::max(top.mm, 0.1);  // equal faces are of one colour, not of their noise
  return top;
}

/// The vertices that lie in the box at rest, in all the faces that are drawn.
Points shown_points(const FaceBox& box, const Points& rest, const std::vector<TriMesh>& faces) {
  std::vector<Vec3> kept;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    if (!box.holds(rest.row(v))) continue;
    for (const TriMesh& face : faces) kept.emplace_back(face.points.row(v));
  }
  Points points(Eigen::Index(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) points.row(Eigen::Index(i)) = kept[i].transpose();
  return points;
}

}  // namespace

MostDifferent differs_most(const std::vector<metrics::VariantComparison>& compared) {
  MostDifferent most;
  double most_m = -1;
  for (std::size_t i = 0; i < compared.size(); ++i) {
    const auto& of_frame = compared[i].difference.frame_max_m;
    const auto farthest = std::max_element(of_frame.begin(), of_frame.end());
    if (farthest == of_frame.end() || *farthest <= most_m) continue;
    most_m = *farthest;
    most = {i, std::size_t(farthest - of_frame.begin())};
  }
  return most;
}

std::array<render::Camera, 3> cameras_on(const Points& framed, double aspect) {
  const Vec3 left = render::three_quarter_view(), right(-left.x(), left.y(), left.z());
  std::array cameras{render::framing(framed, right, aspect),
                     render::framing(framed, render::front_view(), aspect),
                     render::framing(framed, left, aspect)};
  double height_m = 0;
  for (const render::Camera& camera : cameras) height_m = std::max(height_m, camera.height_m);
  for (render::Camera& camera : cameras) camera.height_m = height_m;
  return cameras;
}

void draw_variants(const Results& base, const std::vector<metrics::VariantComparison>& compared,
                   const std::vector<VariantRun>& runs, const std::filesystem::path& file) {
  const face::FaceFrame frame = face::face_frame(base.inputs.landmarks);
  const simulate::Performance& p = base.simulation.performance;
  const MostDifferent most = differs_most(compared);
  const std::size_t shown = most.frame;
  const auto skin_then = [&](const simulate::Performance& of) {
    const PointsF& d = of.skin_displacement_m[shown];
    return TriMesh{frame.local_points(p.skin_rest.points + d.cast<double>()),
                   p.skin_rest.triangles};
  };
  const ColourTop top = colour_top(compared);
  const render::RenderOptions size{.width_px = 300, .height_px = 380};
  const double aspect = double(size.width_px) / size.height_px;
  std::vector<TriMesh> faces{skin_then(p)};
  for (const VariantRun& run : runs) faces.push_back(skin_then(run.simulation.performance));
  render::ContactSheet sheet;
  sheet.title = base.scene.title.empty() ? "Variants" : base.scene.title + ": variants";
  sheet.note = fmt::format(
      "the faces at {:.3f} s, where {} differs most; colour: greatest distance over time from the "
      "unchanged face; R and L: the subject's own sides",
      p.frame_time_s[shown], compared[most.variant].name);
  sheet.columns = int(runs.size()) + 1;
  sheet.bar = render::ColourBar{{0, top.mm}, "distance (mm)", top.capped};
  const report::FaceBacking backing =
      backing_in_frame(p.skin_rest, base.inputs.landmarks, base.teeth, frame);
  const auto drawn = [&](const render::Surface& skin, const simulate::Performance& own_run,
                         const render::Camera& camera) {
    const BackingSurfaces behind(backing, frame, skin.mesh.points, base.teeth,
                                 own_run.jaw_now_from_rest[shown],
                                 own_run.upper_teeth_now_from_rest, gaze_in(own_run, shown));
    return render::render(behind.with(skin), camera, size);
  };
  const auto cameras = cameras_on(shown_points(face_box(base.inputs.landmarks, frame),
                                               frame.local_points(p.skin_rest.points), faces),
                                  aspect);
  constexpr std::array from = {"from the right", "from in front", "from the left"};
  const std::size_t columns = runs.size() + 1;
  sheet.pictures.resize(cameras.size() * columns);
  run_each(sheet.pictures.size(), [&](std::size_t at) {
    const std::size_t view = at / columns, face = at % columns;
    const auto caption = [&](const std::string& name) {
      return fmt::format("{}, {}", name, from[view]);
    };
    const render::SideMarks marks = render::side_marks(cameras[view]);
    if (face == 0) {
      sheet.pictures[at] = {drawn({.mesh = faces[0]}, p, cameras[view]), caption("base"), marks};
      return;
    }
    const render::Surface surface{
        .mesh = faces[face],
        .scalar = (1e3 * compared[face - 1].difference.greatest_m).cast<float>(),
        .range = {0, top.mm}};
    sheet.pictures[at] = {drawn(surface, runs[face - 1].simulation.performance, cameras[view]),
                          caption(compared[face - 1].name), marks};
  });
  render::write_png(file, render::contact_sheet(sheet));
}

namespace {

/// The title, the legend, and what S compares; returns the height down to which they reach.
double draw_symmetry_heading(render::Canvas& canvas, const std::string& title,
                             const std::vector<render::PlotCurve>& curves) {
  canvas.text(70, 42, title + ": symmetry of motion", {.size_px = 20, .bold = true});
  double y = 72 + draw_legend(canvas, 70, 870, 72, curves);
  for (const char* line : metrics::kWhatSCompares) {
    canvas.text(70, y, line, {.size_px = 13});
    y += 18;
  }
  return y;
}

}  // namespace

void draw_variant_symmetry(const Results& base, const std::vector<VariantRun>& runs,
                           const std::filesystem::path& file) {
  const metrics::SymmetryCurve& own = base.symmetry.curve;
  if (own.time_s.size() < 2) return;
  std::vector<const metrics::SymmetryCurve*> faces{&own};
  std::vector<std::string> names{"base"};
  for (const VariantRun& run : runs) {
    faces.push_back(&run.symmetry.curve);
    names.push_back(run.scene.title);
  }
  std::vector<std::vector<double>> s, difference;  // the latter less that of base
  for (const metrics::SymmetryCurve* face : faces) {
    s.push_back(face->s);
    s.back().front() = NAN;  // S(t0) is not defined
    difference.push_back(metrics::added_difference(*face, own));
  }
  std::vector<render::PlotCurve> s_curves, difference_curves;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    s_curves.push_back({s[i], render::face_colour(i), names[i]});
    difference_curves.push_back({difference[i], render::face_colour(i), ""});
  }
  render::Canvas canvas(900, 740 + 20 * int(faces.size() / 3));
  double y = draw_symmetry_heading(canvas, base.scene.title.empty() ? "Variants" : base.scene.title,
                                   s_curves);
  const render::Range time{own.time_s.front(), own.time_s.back()};
  for (auto& curve : s_curves) curve.name.clear();
  std::vector<double> floor;
  for (const double value : own.floors()) floor.push_back(std::log(value));
  if (!floor.empty())
    s_curves.push_back({floor, render::palette::cut,
                        own.mesh_noise.empty() ? fmt::format("undecided below: {:.2g} mm of jitter",
                                                             1e3 * own.jitter_m)
                                               : std::string("undecided below: mesh and jitter")});
  const render::TimePlot upper{70,
                               y + 18,
                               800,
                               260,
                               time,
                               render::span_of(s_curves),
                               "S = ln |xi_L - xi_R|; smaller: both sides stretch more alike"};
  render::draw_axes(canvas, upper);
  if (!floor.empty()) render::shade_under(canvas, upper, own.time_s, floor);
  render::draw_curves(canvas, upper, own.time_s, s_curves);
  y += 18 + 260 + 50;
  const render::TimePlot lower{70,
                               y,
                               800,
                               190,
                               time,
                               render::span_of(difference_curves),
                               "xi_L - xi_R less that of base (1): what the variant adds"};
  render::draw_axes(canvas, lower);
  render::draw_curves(canvas, lower, own.time_s, difference_curves);
  canvas.text(470, y + 190 + 36, "time (s)", {.size_px = 13, .align = render::Align::centre});
  canvas.text(70, y + 190 + 60, "No medical device: these figures diagnose nothing.",
              {.size_px = 12, .colour = render::palette::faint_ink});
  render::write_png(file, canvas.image());
}

}  // namespace hyperex::run
