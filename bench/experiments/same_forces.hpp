// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include "experiments/models.hpp"

namespace hyperex::bench {

/// Experiment 3 driven one way: models 2 and 3 against model 1.
struct DrivenWay {
  std::array<ModelPair, 2> pairs;
  double added[2] = {};          ///< greatest change of xi_L - xi_R against model 1, with sign
  double spread = 0;             ///< greatest spread of S over the three
  double upper_lip_mm[3] = {};   ///< way of the middle of the upper lip (ibug68_51) at the end
  double jitter_to_tell_mm = 0;  ///< of the points, at which models 2 and 3 are told apart
  double driven_off_mm = 0;      ///< of model 1 from the recording, at most
};

struct SameForcesFace {
  std::string name;
  DrivenWay by_displacement, by_muscles;
};

/// Experiment 3 as the thesis does it, points prescribed in each tissue, and with the forces of
/// muscles that model 1 needs.
std::vector<SameForcesFace> hyper_expression_by_muscles(const Setting& setting);

/// Its part of docs/experiments.md.
std::string same_forces_section(const std::vector<SameForcesFace>& faces);

}  // namespace hyperex::bench
