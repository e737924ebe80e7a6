// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/mirrored_twin.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::session {

/// S(t), excursions and the asymmetry map of a simulated face, judged by the jitter of its input
/// and by its mirrored twin, if it has one.
metrics::SymmetryMeasures symmetry_measures(const scene::Scene& scene, const Inputs& inputs,
                                            const metrics::RestAsymmetry& at_rest,
                                            const simulate::Performance& performance,
                                            const MirroredTwin& twin);

}  // namespace hyperex::session
