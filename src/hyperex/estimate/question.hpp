// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/estimate/known_load.hpp"

namespace hyperex::estimate {

/// A ratio of Young's moduli: that of one part of the tissue to that of another, or to what the
/// scene has there. Ratios alone: motion by muscles does not determine absolute stiffness.
struct StiffnessRatio {
  std::string name;  ///< "cheek_L / cheek_R"
  /// Per tetrahedron, 0 to 1: how much of the change applies. With the ratio r, Young's modulus is
  /// multiplied by 1 + over (sqrt(r) - 1) and 1 + under (1 / sqrt(r) - 1); where `under` is empty,
  /// by 1 + over (r - 1).
  std::vector<double> over, under;
};

/// What is to be found from recordings.
struct Question {
  std::vector<StiffnessRatio> ratios;
  /// Muscles, or branches of a side, as MuscleGain::muscle: how strongly they act relative to the
  /// effort, which is much the same for both sides (Assumptions).
  std::vector<std::string> gains;
  /// Where there are any, the stiffness of the whole tissue is found too.
  std::vector<KnownLoad> loads = {};
};

}  // namespace hyperex::estimate
