// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "experiments/setting.hpp"

namespace hyperex::bench {

/// A run compared with a reference that follows its input at once: the same element with a
/// hundredth of the viscosity and mass.
struct PhysicsRow {
  std::string element, form;
  double viscosity_pa_s = 0;
  double largest_mm = 0;    ///< displacement of the skin, over all frames
  double from_base_mm = 0;  ///< greatest distance of the skin from the first row's, over time
  double lag_median_ms = 0, lag_least_ms = 0,
         lag_most_ms = 0;       ///< of landmarks that are not driven
  double behind_mm = 0;         ///< greatest distance from that reference, over time
  double behind_at_end_mm = 0;  ///< the same in the last frame, when the input is back at rest
  int inverted_tets = 0;
};

struct PhysicsFace {
  std::string name;
  int driven_points = 0, driven_nodes = 0, skull_nodes = 0, mandible_nodes = 0, nodes = 0, tets = 0;
  double young_pa = 0, poisson = 0, viscosity_pa_s = 0;
  double relaxation_ms = 0;             ///< eta / G, G = E / (2 (1 + nu))
  int landmarks = 0;                    ///< those whose lags are evaluated
  double slowest_input_s = 0;           ///< from rest to the peak
  double input_left_mm = 0;             ///< largest displacement of driven points in the last frame
  std::vector<PhysicsRow> elements;     ///< both elements with both viscous tensors
  std::vector<PhysicsRow> viscosities;  ///< the first of them with other viscosities
  double estimated_error = 0;           ///< of the reduced models: largest / largest displacement
};

/// Experiment 2. Writes experiment_2_times.jpg.
std::vector<PhysicsFace> mouth_opening_by_physics(const Setting& setting);

}  // namespace hyperex::bench
