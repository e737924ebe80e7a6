// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {

/// Converts the weights of a model's units to ARKit's blend shapes, by the names and scales in the
/// model. The weight of a blend shape that several units share is their mean.
class ArkitWeights {
 public:
  explicit ArkitWeights(const expression::FaceModel& model);
  /// The blend shapes that the model has, sorted.
  std::vector<std::string> names() const;
  /// Weights, 0 to 1, by name. The frame must be valid.
  std::map<std::string, double> of(const TrackedFrame& frame) const;

 private:
  struct Part {
    Eigen::Index unit;
    double factor;
  };
  std::map<std::string, std::vector<Part>> parts_;
};

}  // namespace hyperex::tracking
