// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "experiments/meshes.hpp"
#include "experiments/setting.hpp"
#include "experiments/study.hpp"

namespace hyperex::bench {

/// The time window in which the curves of the thesis differ most.
constexpr double kSourceWindow_s[2] = {0.25, 0.6};

/// Model 2 or 3 compared with model 1 (u_b and u_1 are their displacements).
struct ModelPair {
  std::string name;
  double young_change_pa = 0;  ///< at the right crista philtri superior
  double largest_mm = 0, rms_at_end_mm = 0;
  std::string nearest_landmark;     ///< landmark nearest to the largest distance
  double largest_from_cphs_mm = 0;  ///< distance of that place from the right cphs
  double share_near_cphs = 0;       ///< share of the squared distances within 25 mm of the cphs
  double share_near_mouth = 0;      ///< share of it within 25 mm of the middle of the mouth
  double half_radius_mm = 0;        ///< radius about the right cphs that contains half of the sum
  double change_mm = 0,
         moved_mm = 0;        ///< within 10 mm of it, at the end: means of |u_b| - |u_1|, |u_1|
  double change_near_mm = 0;  ///< as change_mm, within 25 mm
  double most_less_mm = 0, most_more_mm = 0;  ///< least and greatest |u_b| - |u_1|
  double lag_ms = 0;                          ///< lag of the right cphs behind that of model 1
};

/// How far S(t) of the three models differ, under one condition.
struct SpreadRow {
  std::string condition, element, form;
  double tissue_2 = 0, tissue_3 = 0;  ///< greatest change of xi_L - xi_R against model 1, with sign
  double spread = 0, spread_at_s = 0;  ///< greatest spread of S, and when
  double spread_in_window = 0;         ///< mean of the spread in the thesis' window
  double share_in_window = 0;          ///< share of the spread's integral over time in that window
};

struct ModelsFace {
  std::string name;
  double end_s = 0;
  double area_share = 0;  ///< share of the skin's area within 25 mm of the right cphs
  double area_share_mouth = 0;
  std::vector<ModelPair> pairs;
  std::vector<SpreadRow> rows;
  std::vector<MeshRow> meshes;
  double s_least = 0, s_most = 0;       ///< range of the three curves from 0.1 s on
  double difference_at_end[3] = {};     ///< xi_L - xi_R of models 1 to 3
  double own_mesh = 0, own_motion = 0;  ///< parts of model 1's xi_L - xi_R, at the end
  double own_least = 0,
         own_least_s = 0;     ///< least |xi_L - xi_R| of model 1 from 0.1 s on, and when
  double at_once_change = 0;  ///< greatest change of S without viscosity and mass, from 0.1 s on
  double parted_most_s = 0, parted_window_share = 0;  ///< of |D_2 - D_3|: when; share in window
  double jitter_mm = 0;                               ///< of the recorded points; 0: exact
  double noise_floor = 0;         ///< S below which jitter alone may explain it; at the end
  double jitter_to_tell_mm = 0;   ///< largest jitter at which models 2 and 3 can be distinguished
  double estimated_error_mm = 0;  ///< of the reduced models, at most
};

/// Compares the skin of `other` with that of `one`.
ModelPair pair_of(const Study& study, const std::string& name, const simulate::Performance& one,
                  const simulate::Performance& other);

/// Experiment 3. Writes experiment_3_symmetry.png and experiment_3_maps_*.jpg.
std::vector<ModelsFace> hyper_expression(const Setting& setting);

}  // namespace hyperex::bench
