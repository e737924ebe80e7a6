// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/visit_picture.hpp"

#include <algorithm>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/metrics/baseline.hpp"
#include "hyperex/render/canvas.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/render/side_marks.hpp"
#include "hyperex/run/backing_surfaces.hpp"

namespace hyperex::visits {
namespace {

Vec3 mirrored(Vec3 v) {
  v.x() = -v.x();
  return v;
}

/// Displacements of the average face's landmarks, in its frame.
struct Displacements {
  Points centres, values;
};

/// Half the difference between a point at rest and the mirror image of its counterpart about the
/// face's own midsagittal plane. The average face, which is symmetric, lacks this asymmetry.
Vec3 own_asymmetry(const MeasuredFace& face, const std::string& name, double middle_x) {
  const std::string other = face::mirrored_landmark(name);
  if (!face.rest.contains(other)) return Vec3::Zero();
  Vec3 here = face.state.axes * face.rest.at(name), there = face.state.axes * face.rest.at(other);
  here.x() -= middle_x;
  there.x() -= middle_x;
  return (here - mirrored(there)) / 2;
}

/// The x of the midsagittal plane: the mean over the pairs of the head that does not move.
double middle_of(const MeasuredFace& face) {
  double sum = 0;
  int count = 0;
  for (const auto& name : {"exocanthion_R", "endocanthion_R"}) {
    const std::string other = face::mirrored_landmark(name);
    if (!face.rest.contains(name) || !face.rest.contains(other)) continue;
    sum += (face.state.axes * (face.rest.at(name) + face.rest.at(other))).x() / 2;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

Displacements displacements_of(const MeasuredFace& face, const io::Landmarks& average) {
  const double middle_x = middle_of(face);
  std::vector<std::pair<Vec3, Vec3>> all;
  for (const auto& [name, rest] : face.rest) {
    if (!average.contains(name) || !face.peak.contains(name)) continue;
    all.emplace_back(average.at(name), face.state.axes * (face.peak.at(name) - rest) +
                                           own_asymmetry(face, name, middle_x));
  }
  for (const int still : metrics::still_ibug_points())
    if (const std::string name = face::ibug(still); !face.rest.contains(name))
      all.emplace_back(average.at(name), Vec3::Zero());
  Displacements out{Points(Eigen::Index(all.size()), 3), Points(Eigen::Index(all.size()), 3)};
  for (std::size_t i = 0; i < all.size(); ++i) {
    out.centres.row(Eigen::Index(i)) = all[i].first.transpose();
    out.values.row(Eigen::Index(i)) = all[i].second.transpose();
  }
  return out;
}

void draw_marks(render::Canvas& canvas, const render::Camera& camera, double width) {
  const render::SideMarks marks = render::side_marks(camera);
  constexpr double margin = 12, baseline = 26;
  const render::TextStyle style{.size_px = 20, .bold = true};
  canvas.text(margin, baseline, marks.at_left, style);
  canvas.text(width - margin, baseline, marks.at_right,
              {.size_px = 20, .align = render::Align::right, .bold = true});
}

}  // namespace

std::optional<render::Image> draw_peak(const MeasuredFace& face) {
  if (!face.state.axes.allFinite()) return std::nullopt;
  const anatomy::EmbeddedFace average = anatomy::embedded_face();
  const face::FaceFrame frame = face::face_frame(average.landmarks);
  io::Landmarks landmarks;
  for (const auto& [name, place] : average.landmarks) landmarks[name] = frame.local(place);
  const Displacements moved = displacements_of(face, landmarks);
  const TriMesh rest{frame.local_points(average.mesh.points), average.mesh.triangles};
  const TriMesh skin{rest.points + Rbf(moved.centres, moved.values, {}).at_all(rest.points),
                     rest.triangles};
  const report::FaceBacking backing =
      run::backing_in_frame(average.mesh, average.landmarks, nullptr, frame);
  const run::BackingSurfaces behind(backing, frame, skin.points, nullptr,
                                    Eigen::Isometry3d::Identity());
  const render::RenderOptions size{.width_px = 300, .height_px = 400};
  const double aspect = double(size.width_px) / size.height_px;
  const render::Camera camera = render::framing(rest.points, render::front_view(), aspect);
  render::Canvas canvas(render::render(behind.with({.mesh = skin}), camera, size));
  draw_marks(canvas, camera, size.width_px);
  return canvas.image();
}

}  // namespace hyperex::visits
