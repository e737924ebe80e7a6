// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/backing_surfaces.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hyperex::run {
namespace {
constexpr std::array<render::Colour, 3> kEye = {
    {{0.93, 0.92, 0.9}, {0.43, 0.36, 0.28}, {0.08, 0.07, 0.06}}};
constexpr render::Colour kPocket{0.13, 0.05, 0.04};
constexpr render::Colour kTooth{0.92, 0.88, 0.79}, kGum{0.72, 0.36, 0.36};

render::VertexColours shaded(const render::Colour& colour, const Eigen::VectorXd& light) {
  render::VertexColours out(light.size(), 3);
  const double channels[] = {colour.r, colour.g, colour.b};
  for (Eigen::Index v = 0; v < light.size(); ++v)
    for (int k = 0; k < 3; ++k)
      out(v, k) = static_cast<std::uint8_t>(std::lround(255 * channels[k] * light[v]));
  return out;
}

}  // namespace

report::FaceBacking backing_in_frame(const TriMesh& skin_rest, const io::Landmarks& landmarks,
                                     const face::FaceFrame& frame) {
  report::FaceBacking backing = report::face_backing(skin_rest, landmarks);
  for (report::Opening& opening : backing.openings)
    opening.inward = frame.local(frame.origin + opening.inward);
  return backing;
}

BackingSurfaces::BackingSurfaces(const report::FaceBacking& backing, const face::FaceFrame& frame,
                                 const Points& skin, const anatomy::Teeth* teeth,
                                 const Eigen::Isometry3d& jaw) {
  for (const report::Eyeball& eye : backing.eyeballs) {
    std::size_t part = 0;
    for (const TriMesh& mesh : report::eyeball_parts(eye))
      parts_.push_back({{frame.local_points(mesh.points), mesh.triangles}, kEye[part++]});
  }
  for (const report::Opening& opening : backing.openings) {
    TriMesh mesh = report::pocket(opening, skin);
    mesh.triangles.col(1).swap(mesh.triangles.col(2));  // seen from behind: darker, no sheen
    parts_.push_back({std::move(mesh), kPocket});
  }
  if (!teeth) return;
  for (const anatomy::JawTeeth* row : {&teeth->upper, &teeth->lower})
    for (const TriMesh* part : {&row->crowns, &row->gum}) {
      if (part->triangles.rows() == 0) continue;
      Points now = part->points;
      if (row == &teeth->lower)
        now = (now * jaw.linear().transpose()).rowwise() + jaw.translation().transpose();
      const render::Colour colour = part == &row->crowns ? kTooth : kGum;
      parts_.push_back({{frame.local_points(now), part->triangles},
                        colour,
                        true,
                        shaded(colour, report::light_in_mouth(*part, row->crowns, frame.z))});
    }
}

std::vector<render::Surface> BackingSurfaces::with(const render::Surface& skin) const {
  std::vector<render::Surface> all{skin};
  for (const Part& part : parts_)
    all.push_back(
        {.mesh = part.mesh, .colours = part.colours, .plain = part.colour, .smooth = part.smooth});
  return all;
}

}  // namespace hyperex::run
