// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/contact/obstacles.hpp"

namespace hyperex::session {

/// The bodies of contact that a scene or one of its variants uses.
struct ObstaclesUsed {
  bool teeth = false, eyes = false;
  bool operator==(const ObstaclesUsed&) const = default;
};
ObstaclesUsed obstacles_used(const scene::Scene& scene);

/// The bodies of contact that a scene or one of its variants uses (contact.teeth, contact.eyes);
/// null where there are none. `teeth`: at rest; null: no teeth.
std::shared_ptr<const std::vector<simulate::Obstacle>> obstacles_of(const scene::Scene& scene,
                                                                    const Inputs& inputs,
                                                                    const tissue::TissueMesh& mesh,
                                                                    const anatomy::Teeth* teeth);

}  // namespace hyperex::session
