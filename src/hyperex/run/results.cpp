// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/outputs.hpp"

namespace hyperex::run {

Results results_of(const session::FaceSession& session) {
  Results results{session.scene(),
                  session.inputs(),
                  session.mesh(),
                  session.simulation(),
                  session.symmetry(),
                  session.notes(),
                  {},
                  session.field()};
  results.teeth = session.teeth().get();
  results.backing = session.backing();
  results.uncertainty = session.skin_uncertainty();
  return results;
}

}  // namespace hyperex::run
