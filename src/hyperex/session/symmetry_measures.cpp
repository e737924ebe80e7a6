// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/symmetry_measures.hpp"

#include "hyperex/core/run_together.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/metrics/pose_floor.hpp"
#include "hyperex/metrics/recorded_sides.hpp"
#include "hyperex/metrics/repetition_floor.hpp"

namespace hyperex::session {

namespace {

/// Displacements from the face at rest after surgery.
std::vector<PointsF> less(std::vector<PointsF> frames, const PointsF& neutral) {
  for (PointsF& frame : frames) frame -= neutral;
  return frames;
}

}  // namespace

metrics::SymmetryMeasures symmetry_measures(const scene::Scene& scene, const Inputs& inputs,
                                            const metrics::RestAsymmetry& at_rest,
                                            const simulate::Performance& p,
                                            const MirroredTwin& twin) {
  const double jitter_m = inputs.jitter_m * scene.drive.gain;
  metrics::SymmetryMeasures all;
  run_together(
      {[&] {
         all.map =
             p.neutral_displacement_m.rows() == 0
                 ? metrics::asymmetry_of(at_rest, p.skin_displacement_m, twin.skin_displacement_m)
                 : metrics::asymmetry_of(
                       at_rest, less(p.skin_displacement_m, p.neutral_displacement_m),
                       less(twin.skin_displacement_m, twin.neutral_displacement_m));
       },
       [&] {
         all.curve = metrics::symmetry_of(p.landmarks, scene.output.symmetry_floor, jitter_m);
         all.excursions = metrics::excursions_of(p.landmarks, jitter_m, scene.output.lowpass_hz);
       }});
  metrics::set_known(all.excursions, {.jitter = inputs.jitter_known});
  all.no_mesh_floor = twin.why_not;
  metrics::add_pose_floors(all.excursions, inputs.pose_variance, scene.drive.gain);
  metrics::add_repetition_floor(all.excursions, 1e3 * scene.output.repetition_m);
  if (twin.why_not.empty())
    metrics::add_mesh_floor(all.curve, all.excursions, p.landmarks, twin.landmarks);
  metrics::withhold_unrecorded(all, p.landmarks, inputs.motion.motion);
  return all;
}

}  // namespace hyperex::session
