// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/output/arkit_weights.hpp"

#include <algorithm>

#include "hyperex/expression/arkit_names.hpp"

namespace hyperex::tracking {

ArkitWeights::ArkitWeights(const expression::FaceModel& model) {
  for (std::size_t k = 0; k < model.animation_units.size(); ++k) {
    const expression::DeformationUnit& unit = model.animation_units[k];
    const auto add = [&](const std::string& names, double factor) {
      for (const auto& name : expression::arkit_names(names))
        parts_[name].push_back({Eigen::Index(k), factor});
    };
    add(unit.arkit, unit.arkit_scale);
    add(unit.arkit_negative, -unit.arkit_negative_scale);
  }
}

std::vector<std::string> ArkitWeights::names() const {
  std::vector<std::string> all;
  for (const auto& [name, parts] : parts_) all.push_back(name);
  return all;
}

std::map<std::string, double> ArkitWeights::of(const TrackedFrame& frame) const {
  std::map<std::string, double> weights;
  for (const auto& [name, parts] : parts_) {
    double sum = 0;
    for (const auto& [unit, factor] : parts)
      sum += std::clamp(factor * frame.weights[unit], 0.0, 1.0);
    weights[name] = sum / double(parts.size());
  }
  return weights;
}

}  // namespace hyperex::tracking
