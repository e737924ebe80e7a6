// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/run/face_box.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/tissue/field/points.hpp"

namespace hyperex::run {
namespace {

render::Image sheet_of(const Results& r, int parameter) {
  const tissue::ParameterInfo& info = tissue::parameter_info(parameter);
  const face::FaceFrame frame = face::face_frame(r.inputs.landmarks);
  const Eigen::VectorXf values = (r.tissue->skin[parameter] / info.si).cast<float>();
  const render::Range range{values.minCoeff(), values.maxCoeff()};
  const TriMesh local{frame.local_points(r.mesh.skin.points), r.mesh.skin.triangles};
  std::vector<tissue::FieldProblem> problems;
  std::vector<render::Marker> markers;
  for (const auto& point : tissue::resolve_points(r.scene.tissue, r.inputs.landmarks, problems))
    if (point.value[parameter])
      markers.push_back(
          {frame.local(r.inputs.landmarks.at(point.landmark)), render::palette::driven, 4});

  render::RenderOptions options;
  options.width_px = 320;
  options.height_px = 400;
  const double aspect = double(options.width_px) / options.height_px;
  const Points framed = points_within(face_box(r.inputs.landmarks, frame), local.points);
  const Vec3 left = render::three_quarter_view(), right(-left.x(), left.y(), left.z());
  const std::array<std::pair<Vec3, const char*>, 3> views{
      {{right, "right side"}, {render::front_view(), "from in front"}, {left, "left side"}}};
  render::ContactSheet sheet;
  sheet.title = info.title;
  sheet.note = markers.empty() ? "over the skin at rest; right and left are the subject's own"
                               : "over the skin at rest; red: where it was given";
  sheet.columns = int(views.size());
  sheet.bar = render::ColourBar{range, info.title};
  const render::Surface surface{.mesh = local, .scalar = values, .range = range};
  for (const auto& [view, caption] : views) {
    const render::Camera camera = render::framing(framed, view, aspect);
    sheet.pictures.push_back(
        {render::render({surface}, camera, options, markers), caption, render::side_marks(camera)});
  }
  return render::contact_sheet(sheet);
}

}  // namespace

void write_tissue_map(const Results& r, const std::filesystem::path& file) {
  std::vector<render::Image> sheets;
  for (int p = 0; p < tissue::parameter_count; ++p)
    if (r.tissue->varies(p)) sheets.push_back(sheet_of(r, p));
  if (sheets.empty()) return;
  int width = 0, height = 0;
  for (const auto& sheet : sheets) {
    width = std::max(width, sheet.width);
    height += sheet.height;
  }
  render::Canvas canvas(width, height);
  int y = 0;
  for (const auto& sheet : sheets) {
    canvas.draw(sheet, 0, y);
    y += sheet.height;
  }
  render::write_png(file, canvas.image());
}

}  // namespace hyperex::run
