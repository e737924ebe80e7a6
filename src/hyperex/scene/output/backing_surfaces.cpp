// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/output/backing_surfaces.hpp"

#include <array>
#include <utility>

namespace hyperex::scene {
namespace {
constexpr std::array<render::Colour, 3> kEye = {
    {{0.93, 0.92, 0.9}, {0.43, 0.36, 0.28}, {0.08, 0.07, 0.06}}};
constexpr render::Colour kPocket{0.13, 0.05, 0.04};
}  // namespace

report::FaceBacking backing_in_frame(const TriMesh& skin_rest, const io::Landmarks& landmarks,
                                     const face::FaceFrame& frame) {
  report::FaceBacking backing = report::face_backing(skin_rest, landmarks);
  for (report::Opening& opening : backing.openings)
    opening.inward = frame.local(frame.origin + opening.inward);
  return backing;
}

BackingSurfaces::BackingSurfaces(const report::FaceBacking& backing, const face::FaceFrame& frame,
                                 const Points& skin) {
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
}

std::vector<render::Surface> BackingSurfaces::with(const render::Surface& skin) const {
  std::vector<render::Surface> all{skin};
  for (const Part& part : parts_)
    all.push_back({.mesh = part.mesh, .plain = part.colour, .smooth = false});
  return all;
}

}  // namespace hyperex::scene
