// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {

/// A model's units as weights of ARKit's blend shapes, by the names and scales of its table. A
/// blend shape that several units share is their mean.
class ArkitWeights {
 public:
  explicit ArkitWeights(const expression::FaceModel& model);
  /// Names that the model has, rising.
  std::vector<std::string> names() const;
  /// 0 to 1 by name. Requires a valid frame.
  std::map<std::string, double> of(const TrackedFrame& frame) const;

 private:
  struct Part {
    Eigen::Index unit;
    double factor;
  };
  std::map<std::string, std::vector<Part>> parts_;
};

}  // namespace hyperex::tracking
