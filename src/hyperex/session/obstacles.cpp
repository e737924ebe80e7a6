// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/obstacles.hpp"

#include <algorithm>

namespace hyperex::session {

std::shared_ptr<const std::vector<simulate::Obstacle>> obstacles_of(const scene::Scene& scene,
                                                                    const Inputs& inputs,
                                                                    const tissue::TissueMesh& mesh,
                                                                    const anatomy::Teeth* teeth) {
  const auto uses = [&](bool simulate::ContactOptions::*what) {
    return scene.contact.*what ||
           std::any_of(scene.variants.begin(), scene.variants.end(),
                       [&](const scene::Variant& variant) { return variant.scene.contact.*what; });
  };
  auto out = std::make_shared<std::vector<simulate::Obstacle>>();
  if (teeth && uses(&simulate::ContactOptions::teeth)) *out = simulate::teeth_obstacles(*teeth);
  if (uses(&simulate::ContactOptions::eyes))
    for (simulate::Obstacle& eye : simulate::eye_obstacles(mesh.skin.points, inputs.landmarks))
      out->push_back(std::move(eye));
  if (out->empty()) return nullptr;
  return out;
}

}  // namespace hyperex::session
