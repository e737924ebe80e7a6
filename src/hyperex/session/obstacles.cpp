// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/obstacles.hpp"

namespace hyperex::session {

ObstaclesUsed obstacles_used(const scene::Scene& scene) {
  ObstaclesUsed used{scene.contact.teeth, scene.contact.eyes};
  for (const scene::Variant& variant : scene.variants) {
    used.teeth = used.teeth || variant.scene.contact.teeth;
    used.eyes = used.eyes || variant.scene.contact.eyes;
  }
  return used;
}

std::shared_ptr<const std::vector<simulate::Obstacle>> obstacles_of(const scene::Scene& scene,
                                                                    const Inputs& inputs,
                                                                    const tissue::TissueMesh& mesh,
                                                                    const anatomy::Teeth* teeth) {
  const ObstaclesUsed used = obstacles_used(scene);
  auto out = std::make_shared<std::vector<simulate::Obstacle>>();
  if (teeth && used.teeth) *out = simulate::teeth_obstacles(*teeth);
  if (used.eyes)
    for (simulate::Obstacle& eye : simulate::eye_obstacles(mesh.skin.points, inputs.landmarks))
      out->push_back(std::move(eye));
  if (out->empty()) return nullptr;
  return out;
}

}  // namespace hyperex::session
