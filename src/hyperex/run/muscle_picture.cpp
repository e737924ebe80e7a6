// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/muscle_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/muscles/muscle_lines.hpp"
#include "hyperex/muscles/muscle_shapes.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/render/canvas.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/render/time_plot.hpp"
#include "hyperex/run/activations.hpp"
#include "hyperex/run/face_box.hpp"
#include "hyperex/simulate/load/known_activation.hpp"

namespace hyperex::run {
namespace {

constexpr double kSheetOpacity = 0.3;  // sheets overlap along the fold
constexpr std::array kBranches = {"temporal", "zygomatic", "buccal", "mandibular", "cervical"};

render::Colour colour_of(const std::string& branch) {
  const auto at = std::find(kBranches.begin(), kBranches.end(), branch);
  return render::face_colour(std::size_t(at - kBranches.begin()));
}

/// For a muscle whose activation the recording does not distinguish from 0.
render::Colour pale(const render::Colour& colour) {
  const auto towards_white = [](double part) { return part + 0.7 * (1 - part); };
  return {towards_white(colour.r), towards_white(colour.g), towards_white(colour.b)};
}

/// The activations of all muscles in one sample.
class AtPeak {
 public:
  explicit AtPeak(const simulate::MuscleCourse& course)
      : course_(course), sample_(most_active_sample(course)) {}
  double time_s() const { return course_.time_s[std::size_t(sample_)]; }
  double activation(const std::string& name) const { return at(course_.activation, name); }
  /// Whether its 95 % interval leaves 0 out.
  bool known(const std::string& name) const {
    return simulate::differs_from_zero(activation(name), at(course_.sigma, name));
  }
  bool mostly_prior(const std::string& name) const {
    return !simulate::muscle_words(course_, row_of(name), sample_).empty();
  }

 private:
  /// Below 0: no such muscle.
  Eigen::Index row_of(const std::string& name) const {
    const auto found = std::find(course_.names.begin(), course_.names.end(), name);
    return found == course_.names.end() ? -1 : found - course_.names.begin();
  }
  double at(const Eigen::MatrixXd& course, const std::string& name) const {
    const Eigen::Index row = row_of(name);
    return row < 0 ? std::nan("") : course(row, sample_);
  }
  const simulate::MuscleCourse& course_;
  Eigen::Index sample_;
};

/// The mark of a muscle: its row of the table, from 1.
void draw_mark(render::Canvas& canvas, double x, double y, std::size_t row,
               const muscles::MuscleTable& table) {
  canvas.disc(x, y, 6.2, colour_of(table[row].branch));
  canvas.text(x, y + 3, std::to_string(row + 1),
              {.size_px = 8.5, .colour = {1, 1, 1}, .align = render::Align::centre, .bold = true});
}

struct View {
  Vec3 to_viewer;
  const char* caption;
  bool left, right;  // the sides whose muscles are drawn
};

/// What all views show.
struct Drawn {
  const TriMesh& skin;  // in the face's frame, as `framed`
  const Points& framed;
  const face::FaceFrame& frame;
  const std::vector<muscles::MuscleLine>& lines;
  const std::vector<muscles::MuscleShape>& shapes;
  const AtPeak& peak;
  const muscles::MuscleTable& table;
};

render::SheetPicture view_of(const View& view, const Drawn& drawn) {
  const auto& [skin, framed, frame, lines, shapes, peak, table] = drawn;
  render::RenderOptions options{.width_px = 440, .height_px = 560};
  options.overlay_bias_m = 0.025;  // as deep as a muscle lies
  const render::Camera camera =
      render::framing(framed, view.to_viewer, double(options.width_px) / options.height_px);
  std::vector<render::Polyline> drawn_lines;
  std::vector<render::Fan> sheets;
  for (std::size_t m = 0; m < lines.size(); ++m) {
    const muscles::MuscleLine& line = lines[m];
    if (!(line.left ? view.left : view.right)) continue;
    const double activation = peak.activation(line.name);
    const render::Colour full = colour_of(table[std::size_t(line.row)].branch);
    const render::Colour colour = peak.known(line.name) ? full : pale(full);
    drawn_lines.push_back({frame.local_points(shapes[m].line), colour,
                           1.5 + (activation > 0 ? 6 * std::min(activation, 1.0) : 0)});
    if (shapes[m].sheet.rows() > 0)
      sheets.push_back({frame.local_points(shapes[m].sheet), colour, kSheetOpacity});
  }
  render::Canvas canvas(render::render({{.mesh = skin}}, camera, options, {}, drawn_lines, sheets));
  for (const muscles::MuscleLine& line : lines) {
    if (!(line.left ? view.left : view.right)) continue;
    // Rings begin at one place, the corner of the mouth or of the eye.
    const bool ring = table[std::size_t(line.row)].kind == muscles::MuscleKind::ring;
    const Vec3 shown_at = line.line.row(ring ? line.line.rows() / 2 : 0);
    const auto at =
        render::project(camera, options.width_px, options.height_px, frame.local(shown_at));
    canvas.disc(at.x, at.y, 7, {1, 1, 1});
    draw_mark(canvas, at.x, at.y, std::size_t(line.row), table);
  }
  return {canvas.image(), view.caption, render::side_marks(camera)};
}

/// As it is printed: what rounds to 0 has no sign.
double to_hundredths(double activation) {
  return std::round(100 * activation) / 100 + 0.0;
}

std::string shown(double activation) {
  return std::isnan(activation) ? "-" : fmt::format("{:.2f}", to_hundredths(activation));
}

render::Image legend(const muscles::MuscleTable& all, const AtPeak& peak, int height_px) {
  constexpr int left = 14, wide = 400;
  const double step = (height_px - 60.0) / double(all.size());
  render::Canvas canvas(wide, height_px);
  const render::TextStyle head{
      .size_px = 11, .colour = render::palette::faint_ink, .align = render::Align::right},
      known{.size_px = 12, .align = render::Align::right, .bold = true},
      unknown{.size_px = 12, .colour = render::palette::faint_ink, .align = render::Align::right},
      faint{.size_px = 11, .colour = render::palette::faint_ink};
  bool relaxes = false;
  canvas.text(wide - 60, 14, "right", head);
  canvas.text(wide - 10, 14, "left", head);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const double y = 30 + step * double(m);
    draw_mark(canvas, left, y - 4, m, all);
    canvas.text(left + 14, y, all[m].latin, {.size_px = 12});
    for (const auto& [side, x] : {std::pair("_R", wide - 60), std::pair("_L", wide - 10)}) {
      const std::string name = all[m].name + side;
      canvas.text(x, y, shown(peak.activation(name)), peak.known(name) ? known : unknown);
      if (peak.mostly_prior(name)) canvas.text(x + 1, y, "*", faint);
      relaxes |= to_hundredths(peak.activation(name)) < 0;
    }
  }
  canvas.text(left - 6, height_px - 28,
              fmt::format("* {}{}", simulate::kMostlyPriorWords,
                          relaxes ? "; below 0: more relaxed than at rest" : ""),
              faint);
  double x = left - 6;
  for (const char* branch : kBranches) {
    canvas.rectangle(x, height_px - 20, 10, 10, colour_of(branch));
    x += 14 + canvas.text(x + 14, height_px - 11, branch, {.size_px = 11}) + 8;
  }
  return canvas.image();
}

}  // namespace

render::Image draw_muscles(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                           const simulate::MuscleCourse& course,
                           const muscles::MuscleTable& table) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const TriMesh skin{frame.local_points(mesh.skin.points), mesh.skin.triangles};
  const Points framed = points_within(face_box(landmarks, frame), skin.points);
  const std::vector<muscles::MuscleLine> lines = muscles::muscle_lines(table, mesh, landmarks);
  const std::vector<muscles::MuscleShape> shapes =
      muscles::muscle_shapes(lines, table, mesh, landmarks);
  const AtPeak peak(course);
  const Vec3 left = render::three_quarter_view(), right(-left.x(), left.y(), left.z());
  const std::array<View, 3> views{{{right, "right side", false, true},
                                   {render::front_view(), "from in front", true, true},
                                   {left, "left side", true, false}}};
  render::ContactSheet sheet;
  sheet.title = "Muscles";
  sheet.note = fmt::format(
      "from origin (disc; of a ring its middle) to insertion; sheets end along the fold; "
      "colour: branch of the facial nerve; numbers and breadth: activation at {:.3f} s, "
      "where the muscles are most active; pale where its 95 % interval holds 0; right and left are "
      "the subject's own",
      peak.time_s());
  sheet.columns = 4;
  sheet.pictures.resize(views.size());
  run_each(views.size(), [&](std::size_t i) {
    sheet.pictures[i] = view_of(views[i], {skin, framed, frame, lines, shapes, peak, table});
  });
  const int height_px = sheet.pictures.front().image.height;
  sheet.pictures.push_back({legend(table, peak, height_px), ""});
  return render::contact_sheet(sheet);
}

}  // namespace hyperex::run
