// SPDX-License-Identifier: GPL-3.0-or-later
// Draws docs/images/teeth.png: average rows a little open, with the tongue, from in front, from the
// side and, of the lower one, from above.
#include <iostream>
#include <vector>

#include "hyperex/anatomy/teeth/dental_arch.hpp"
#include "hyperex/anatomy/teeth/tongue.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/canvas.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/report/mouth_colours.hpp"

using namespace hyperex;

namespace {

render::Surface surface_of(const TriMesh& mesh, const report::Srgb& colour) {
  return {.mesh = mesh, .plain = {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "draw_teeth: expected the name of the picture to write\n";
    return 2;
  }
  constexpr double open_m = 0.012;
  constexpr int size_px = 400, height_px = 330;
  const face::FaceFrame frame{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  anatomy::Teeth teeth = anatomy::dental_arches();
  teeth.tongue = anatomy::tongue_in(teeth, frame);
  for (TriMesh* part : {&teeth.lower.crowns, &teeth.lower.gum, &teeth.tongue})
    part->points.col(1).array() -= open_m;
  const std::vector<render::Surface> lower = {surface_of(teeth.lower.crowns, report::kCrownColour),
                                              surface_of(teeth.lower.gum, report::kGumColour),
                                              surface_of(teeth.tongue, report::kTongueColour)};
  std::vector<render::Surface> both = lower;
  both.push_back(surface_of(teeth.upper.crowns, report::kCrownColour));
  both.push_back(surface_of(teeth.upper.gum, report::kGumColour));
  Points all(teeth.upper.gum.points.rows() + teeth.lower.gum.points.rows(), 3);
  all << teeth.upper.gum.points, teeth.lower.gum.points;
  render::Canvas canvas(3 * size_px, height_px);
  const auto draw = [&](const std::vector<render::Surface>& what, const Vec3& view, const Vec3& up,
                        int place) {
    const render::Camera camera = render::framing(all, view, double(size_px) / height_px, up, 0.05);
    canvas.draw(render::render(what, camera, {.width_px = size_px, .height_px = height_px}),
                place * size_px, 0);
  };
  draw(both, render::front_view(), Vec3::UnitY(), 0);
  draw(both, render::three_quarter_view(), Vec3::UnitY(), 1);
  draw(lower, Vec3::UnitY(), Vec3::UnitZ(), 2);
  render::write_png(argv[1], canvas.image());
  return 0;
}
