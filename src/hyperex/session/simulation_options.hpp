// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::session {

/// The scene's options in the form that simulate/ takes, with uniform tissue.
simulate::SimulationOptions simulation_options(const scene::Scene& scene, const Inputs& inputs);

}  // namespace hyperex::session
