// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/backing_surfaces.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "hyperex/report/eye_model.hpp"
#include "hyperex/report/mouth_colours.hpp"

namespace hyperex::run {
namespace {

render::VertexColours shaded(const report::Srgb& colour, const Eigen::VectorXd& light) {
  render::VertexColours out(light.size(), 3);
  for (Eigen::Index v = 0; v < light.size(); ++v)
    for (int k = 0; k < 3; ++k)
      out(v, k) = static_cast<std::uint8_t>(std::lround(colour[std::size_t(k)] * light[v]));
  return out;
}

render::VertexColours listed(const std::vector<report::Srgb>& colours) {
  render::VertexColours out(Eigen::Index(colours.size()), 3);
  for (std::size_t v = 0; v < colours.size(); ++v)
    for (int k = 0; k < 3; ++k) out(Eigen::Index(v), k) = colours[v][std::size_t(k)];
  return out;
}

}  // namespace

report::FaceBacking backing_in_frame(const TriMesh& skin_rest, const io::Landmarks& landmarks,
                                     const anatomy::Teeth* teeth, const face::FaceFrame& frame) {
  report::FaceBacking backing = report::face_backing(skin_rest, landmarks, teeth);
  for (report::Opening& opening : backing.openings) {
    opening.inward = frame.local(frame.origin + opening.inward);
    opening.rest = frame.local_points(opening.rest);
  }
  return backing;
}

std::optional<expression::EyesGaze> gaze_in(const simulate::Performance& performance,
                                            std::size_t frame) {
  if (performance.gaze.empty()) return std::nullopt;
  return performance.gaze.at(frame);
}

BackingSurfaces::BackingSurfaces(const report::FaceBacking& backing, const face::FaceFrame& frame,
                                 const Points& skin, const anatomy::Teeth* teeth,
                                 const Eigen::Isometry3d& jaw, const Eigen::Isometry3d& upper,
                                 const std::optional<expression::EyesGaze>& gaze) {
  for (const report::Eyeball& eye :
       gaze ? report::turned(backing.eyeballs, *gaze) : backing.eyeballs) {
    const TriMesh mesh = report::placed_eye(eye);
    parts_.push_back(
        {{frame.local_points(mesh.points), mesh.triangles}, {}, true, report::eye_model().colours});
  }
  Eigen::Isometry3d face_from_scan = Eigen::Isometry3d::Identity();
  face_from_scan.linear() = frame.face_from_scan();
  face_from_scan.translation() = -(face_from_scan.linear() * frame.origin);
  const Eigen::Isometry3d jaw_of_face =
      teeth ? face_from_scan * jaw * face_from_scan.inverse() : Eigen::Isometry3d::Identity();
  double light = 1;
  for (const report::Opening& opening : backing.openings) {
    if (opening.mouth) light = report::light_between_lips(opening.loop, skin);
    TriMesh mesh = report::pocket(opening, skin, jaw_of_face);
    mesh.triangles.col(1).swap(mesh.triangles.col(2));  // seen from behind: darker, no sheen
    parts_.push_back({std::move(mesh), {}, true, listed(opening.colours)});
  }
  if (teeth) add_teeth(*teeth, frame, jaw, upper, light);
}

void BackingSurfaces::add_teeth(const anatomy::Teeth& teeth, const face::FaceFrame& frame,
                                const Eigen::Isometry3d& jaw, const Eigen::Isometry3d& upper,
                                double light) {
  const auto add = [&](const TriMesh& part, const TriMesh& crowns, const report::Srgb& colour,
                       const Eigen::Isometry3d& moved) {
    if (part.triangles.rows() == 0) return;
    const Points now =
        (part.points * moved.linear().transpose()).rowwise() + moved.translation().transpose();
    parts_.push_back({{frame.local_points(now), part.triangles},
                      {},
                      true,
                      shaded(colour, light * report::light_in_mouth(part, crowns, frame.z))});
  };
  add(teeth.upper.crowns, teeth.upper.crowns, report::kCrownColour, upper);
  add(teeth.upper.gum, teeth.upper.crowns, report::kGumColour, upper);
  add(teeth.lower.crowns, teeth.lower.crowns, report::kCrownColour, jaw);
  add(teeth.lower.gum, teeth.lower.crowns, report::kGumColour, jaw);
  add(teeth.tongue, teeth.lower.crowns, report::kTongueColour, jaw);
}

std::vector<render::Surface> BackingSurfaces::with(const render::Surface& skin) const {
  std::vector<render::Surface> all{skin};
  for (const Part& part : parts_)
    all.push_back(
        {.mesh = part.mesh, .colours = part.colours, .plain = part.colour, .smooth = part.smooth});
  return all;
}

}  // namespace hyperex::run
