// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include "experiments/models.hpp"

namespace hyperex::bench {

/// Experiment 3 with one kind of drive: models 2 and 3 compared with model 1.
struct DrivenWay {
  std::array<ModelPair, 2> pairs;
  double added[2] = {};          ///< greatest change of xi_L - xi_R from that of model 1, with sign
  double spread = 0;             ///< greatest spread of S over the three
  double upper_lip_mm[3] = {};   ///< of the middle of the upper lip (ibug68_51) at the end
  double jitter_to_tell_mm = 0;  ///< largest at which models 2 and 3 can be distinguished
  double driven_off_mm = 0;      ///< largest distance of model 1 from the recording
};

struct SameForcesFace {
  std::string name;
  DrivenWay by_displacement, by_muscles;
};

/// Experiment 3 as in the thesis, with points prescribed in each tissue, and with the muscle forces
/// that model 1 needs, applied to all models.
std::vector<SameForcesFace> hyper_expression_by_muscles(const Setting& setting);

/// The section of docs/experiments.md about it.
std::string same_forces_section(const std::vector<SameForcesFace>& faces);

}  // namespace hyperex::bench
