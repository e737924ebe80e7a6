// SPDX-License-Identifier: GPL-3.0-or-later
// The face that comes with Hyperex opens its mouth: how far do its corners travel?
#include <cstdio>
#include <hyperex/hyperex.hpp>

using namespace hyperex;

int main() try {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  const auto mesh = std::make_shared<const tissue::TissueMesh>(
      tissue::build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded face"));

  // For a recording of your own: read_motion() and fill_gaps() come first. The head's own motion is
  // removed; the rest is carried to this face.
  const motion::Motion recorded = motion::embedded_mouth_opening(face.landmarks);
  const simulate::AlignedMotion motion =
      simulate::align(motion::stabilise(recorded).motion, face.landmarks);

  simulate::Simulator simulator(mesh, face.landmarks, motion);
  simulate::RunCallbacks callbacks;
  callbacks.progress = [](double share) { std::fprintf(stderr, "\r%3.0f %%", 100 * share); };
  const simulate::SimulationResult result = simulator.run(callbacks);

  std::printf("%d unknowns, %zu frames\n", result.report.free_dofs,
              result.performance.frame_time_s.size());
  for (const auto& pair : metrics::excursions_of(result.performance.landmarks).pairs)
    if (pair.name == "cheilion")  // the corners of the mouth
      std::printf("excursion of the corners: left %.2f mm, right %.2f mm\n",
                  pair.left_side.excursion_mm, pair.right_side.excursion_mm);
} catch (const InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
