// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/visit_picture.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/same_place.hpp"
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

/// A landmark of the average face, in its frame, and its displacement.
struct MovedPlace {
  Vec3 at, way;
};
/// By face::place_name().
using MovedPlaces = std::map<std::string, MovedPlace>;

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

/// Of a place that has two names, the anatomical one counts. The point between the lips is left
/// out, since it belongs to both.
MovedPlaces moved_places(const MeasuredFace& face, const io::Landmarks& average) {
  const double middle_x = middle_of(face);
  MovedPlaces all;
  for (const auto& [name, rest] : face.rest) {
    const bool doubled =
        face::place_name(name) == name && face.rest.contains(face::other_name(name));
    if (doubled || name == "stomion" || !average.contains(name) || !face.peak.contains(name))
      continue;
    const Vec3 way =
        face.state.axes * (face.peak.at(name) - rest) + own_asymmetry(face, name, middle_x);
    all[face::place_name(name)] = {average.at(name), way};
  }
  for (const int still : metrics::still_ibug_points())
    if (const std::string name = face::ibug(still); !all.contains(name))
      all[name] = {average.at(name), Vec3::Zero()};
  return all;
}

/// The average face's lips are closed. Points of both lips that would come nearer meet half way.
void keep_lips_apart(MovedPlaces& places) {
  for (const auto& [upper, lower] : {std::pair{61, 67}, {62, 66}, {63, 65}}) {
    const auto above = places.find(face::ibug(upper)), below = places.find(face::ibug(lower));
    if (above == places.end() || below == places.end()) continue;
    const double beyond = below->second.way.y() - above->second.way.y();
    if (beyond <= 0) continue;
    above->second.way.y() += beyond / 2;
    below->second.way.y() -= beyond / 2;
  }
}

/// Interpolates the displacements of all places but those of one lip. `lip`: 1 upper, -1 lower.
Rbf without_lip(const MovedPlaces& places, int lip) {
  std::vector<MovedPlace> kept;
  for (const auto& [name, place] : places)
    if (anatomy::lip_of(name) != lip) kept.push_back(place);
  Points at(Eigen::Index(kept.size()), 3), way(at.rows(), 3);
  for (Eigen::Index i = 0; i < at.rows(); ++i) {
    at.row(i) = kept[std::size_t(i)].at.transpose();
    way.row(i) = kept[std::size_t(i)].way.transpose();
  }
  return {at, way};
}

/// The vertices of `rest` displaced. Each lip follows its own points and those off the lips: points
/// of the other lip touch it at rest, but move apart from it. Beside the corners of the mouth both
/// interpolations pass into each other. `margin`: anatomy::upper_lip_margin() of each vertex.
Points displaced(const Points& rest, const std::vector<double>& margin, const MovedPlaces& places) {
  constexpr double own_lip_m = 0.005;  // the margin of the lips' rims is at least this
  const Points upper = without_lip(places, -1).at_all(rest),
               lower = without_lip(places, 1).at_all(rest);
  Points out = rest;
  for (Eigen::Index v = 0; v < out.rows(); ++v) {
    const double t = std::clamp((1 + margin[std::size_t(v)] / own_lip_m) / 2, 0.0, 1.0);
    const double share = t * t * (3 - 2 * t);
    out.row(v) += share * upper.row(v) + (1 - share) * lower.row(v);
  }
  return out;
}

/// As peak_surface().
Points surface_at_peak(const MeasuredFace& face, const anatomy::EmbeddedFace& average,
                       const face::FaceFrame& frame) {
  io::Landmarks landmarks;
  for (const auto& [name, place] : average.landmarks) landmarks[name] = frame.local(place);
  MovedPlaces places = moved_places(face, landmarks);
  keep_lips_apart(places);
  return displaced(frame.local_points(average.mesh.points),
                   anatomy::upper_lip_margin(average.mesh, average.landmarks), places);
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

std::optional<Points> peak_surface(const MeasuredFace& face) {
  if (!face.state.axes.allFinite()) return std::nullopt;
  const anatomy::EmbeddedFace average = anatomy::embedded_face();
  return surface_at_peak(face, average, face::face_frame(average.landmarks));
}

std::optional<render::Image> draw_peak(const MeasuredFace& face) {
  if (!face.state.axes.allFinite()) return std::nullopt;
  const anatomy::EmbeddedFace average = anatomy::embedded_face();
  const face::FaceFrame frame = face::face_frame(average.landmarks);
  const TriMesh skin{surface_at_peak(face, average, frame), average.mesh.triangles};
  const report::FaceBacking backing =
      run::backing_in_frame(average.mesh, average.landmarks, nullptr, frame);
  const run::BackingSurfaces behind(backing, frame, skin.points, nullptr,
                                    Eigen::Isometry3d::Identity());
  const render::RenderOptions size{.width_px = 300, .height_px = 400};
  const double aspect = double(size.width_px) / size.height_px;
  const render::Camera camera =
      render::framing(frame.local_points(average.mesh.points), render::front_view(), aspect);
  render::Canvas canvas(render::render(behind.with({.mesh = skin}), camera, size));
  draw_marks(canvas, camera, size.width_px);
  return canvas.image();
}

}  // namespace hyperex::visits
