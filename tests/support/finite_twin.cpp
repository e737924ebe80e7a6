// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/finite_twin.hpp"

#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::test {

std::vector<motion::Motion> at_finite_strain(const TwinFace& face,
                                             const simulate::AlignedMotion& motion,
                                             const muscles::MuscleTable& muscles,
                                             double young_factor,
                                             const std::vector<TwinChange>& changes) {
  simulate::SimulationOptions options = face.options;
  options.model.strain = simulate::Strain::finite;
  options.drive.by = simulate::DriveBy::muscles;
  options.drive.points = motion.motion.names;
  options.muscles.own = muscles;
  options.tissue.uniform[tissue::young] *= young_factor;
  simulate::Simulator simulator(face.mesh, face.landmarks, motion, options);
  std::vector<motion::Motion> out = {simulator.run().performance.landmarks};
  for (motion::Motion& tracks : tracks_after(simulator, face, changes))
    out.push_back(std::move(tracks));
  return out;
}

}  // namespace hyperex::test
