// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/reenact/simulator.hpp"
#include "hyperex/scene/grammar/scene.hpp"
#include "hyperex/scene/stages/inputs.hpp"

namespace hyperex::scene {

/// simulator.prepare() with the order of elimination that an earlier run kept in scene.kept; where
/// there is none, or of other prescribed unknowns, the one found is kept there.
void prepare_with_kept_order(const Scene& scene, const Inputs& inputs,
                             reenact::Simulator& simulator);

/// As bytes and back; null where the bytes are not of this.
std::string bytes_of(const reenact::EliminationOrder& order);
std::shared_ptr<const reenact::EliminationOrder> order_from(const std::string& bytes);

}  // namespace hyperex::scene
