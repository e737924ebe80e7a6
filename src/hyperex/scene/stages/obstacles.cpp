// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/stages/obstacles.hpp"

#include <algorithm>

namespace hyperex::scene {

std::shared_ptr<const std::vector<reenact::Obstacle>> obstacles_of(const Scene& scene,
                                                                   const Inputs& inputs,
                                                                   const tissue::TissueMesh& mesh,
                                                                   const tissue::Teeth* teeth) {
  const auto asked = [&](bool reenact::ContactOptions::*what) {
    return scene.contact.*what ||
           std::any_of(scene.variants.begin(), scene.variants.end(),
                       [&](const Variant& variant) { return variant.scene.contact.*what; });
  };
  auto out = std::make_shared<std::vector<reenact::Obstacle>>();
  if (teeth && asked(&reenact::ContactOptions::teeth)) *out = reenact::teeth_to_touch(*teeth);
  if (asked(&reenact::ContactOptions::eyes))
    for (reenact::Obstacle& eye : reenact::eyes_to_touch(mesh.skin.points, inputs.landmarks))
      out->push_back(std::move(eye));
  if (out->empty()) return nullptr;
  return out;
}

}  // namespace hyperex::scene
