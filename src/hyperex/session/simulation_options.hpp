// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::session {

/// Options of the simulation as simulate/ understands them, the tissue uniform.
simulate::SimulationOptions simulation_options(const scene::Scene& scene, const Inputs& inputs);

}  // namespace hyperex::session
