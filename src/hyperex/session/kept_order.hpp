// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::session {

/// simulator.prepare() with the order of elimination that an earlier run kept in scene.kept; where
/// there is none, or one for other prescribed unknowns, the new order is kept there.
void prepare_with_kept_order(const scene::Scene& scene, const Inputs& inputs,
                             simulate::Simulator& simulator);

/// To bytes and back; null where the bytes hold no order.
std::string bytes_of(const simulate::EliminationOrder& order);
std::shared_ptr<const simulate::EliminationOrder> order_from(const std::string& bytes);

}  // namespace hyperex::session
