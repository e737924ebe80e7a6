// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/correctives.hpp"

namespace hyperex::rig {

const std::vector<expression::ShapePair>& clashing_pairs() {
  static const std::vector<expression::ShapePair> pairs = {
      {"jawOpen", "mouthClose"},         {"jawOpen", "mouthFunnel"},
      {"jawOpen", "mouthPucker"},        {"jawOpen", "mouthSmileLeft"},
      {"jawOpen", "mouthSmileRight"},    {"mouthFunnel", "mouthSmileLeft"},
      {"mouthFunnel", "mouthSmileRight"}};
  return pairs;
}

PointsF skin_at(const std::vector<report::RigShape>& shapes,
                const std::map<std::string, double>& weights) {
  PointsF moved;
  if (shapes.empty()) return moved;
  moved.setZero(shapes.front().displacement_m.rows(), 3);
  const auto weight_of = [&](const report::RigShape& shape) {
    const auto at = weights.find(shape.name);
    return at == weights.end() ? 0.0 : at->second;
  };
  for (const report::RigShape& shape : shapes) {
    double weight = shape.corrects ? 1 : weight_of(shape);
    if (shape.corrects)
      for (const std::size_t one : *shape.corrects) weight *= weight_of(shapes.at(one));
    if (weight != 0) moved += float(weight) * shape.displacement_m;
  }
  return moved;
}

}  // namespace hyperex::rig
