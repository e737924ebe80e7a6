// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/reenact/obstacles.hpp"
#include "hyperex/scene/stages/inputs.hpp"

namespace hyperex::scene {

/// What tissue may touch in a scene or one of its variants (contact.teeth, contact.eyes); null
/// where none asks for it. `teeth`: at rest; null: there are none.
std::shared_ptr<const std::vector<reenact::Obstacle>> obstacles_of(const Scene& scene,
                                                                   const Inputs& inputs,
                                                                   const tissue::TissueMesh& mesh,
                                                                   const tissue::Teeth* teeth);

}  // namespace hyperex::scene
