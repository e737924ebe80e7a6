// SPDX-License-Identifier: GPL-3.0-or-later
// One simulator, five stiffnesses: how far do the cheeks follow an opening mouth?
#include <algorithm>
#include <cstdio>
#include <hyperex/hyperex.hpp>

using namespace hyperex;

/// Greatest distance of a landmark from its place at rest.
double travel_mm(const motion::Motion& landmarks, const char* name) {
  return std::ranges::max(metrics::distance_from_rest_mm(landmarks, {landmarks.index_of(name)}));
}

int main() {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  const auto mesh = std::make_shared<const tissue::TissueMesh>(
      tissue::build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded face"));
  const motion::Motion opening = motion::embedded_mouth_opening(face.landmarks);
  simulate::Simulator simulator(mesh, face.landmarks,
                                simulate::align(motion::stabilise(opening).motion, face.landmarks));

  std::puts("young_kpa,cheek_L_mm,cheek_R_mm");
  for (const double young_kpa : {25.0, 50.0, 100.0, 200.0, 400.0}) {
    simulate::TissueValues values = simulator.options().tissue;
    values.uniform[tissue::young] = 1e3 * young_kpa;
    simulator.set_tissue(values);  // the mesh, its boundary and the order of elimination are kept
    const motion::Motion moved = simulator.run().performance.landmarks;
    std::printf("%g,%.3f,%.3f\n", young_kpa, travel_mm(moved, "cheek_L"),
                travel_mm(moved, "cheek_R"));
  }
}
