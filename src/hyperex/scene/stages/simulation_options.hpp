// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/reenact/simulator.hpp"
#include "hyperex/scene/stages/inputs.hpp"

namespace hyperex::scene {

/// Options of the simulation as reenact/ understands them, the tissue uniform.
reenact::SimulationOptions simulation_options(const Scene& scene, const Inputs& inputs);

}  // namespace hyperex::scene
