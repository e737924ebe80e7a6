// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hyperex/simulate/performance.hpp"

namespace hyperex::run {

/// The sample in which all muscles together are most active.
Eigen::Index most_active_sample(const simulate::MuscleCourse& muscles);

/// Writes activations.csv with one row per sample of the motion: time_s, jaw_opening_deg, then for
/// each muscle its activation and its standard deviation. At activation 1 a muscle moves some part
/// of the skin by 10 mm. `muscles` must have names.
void write_activations_csv(const std::filesystem::path& file,
                           const simulate::MuscleCourse& muscles);

/// For summary.json, at the sample of the greatest summed activation: activation and standard
/// deviation of each group on each side, the share of its variance that the recording determines,
/// and `note` where the activation is mostly the prior's choice. Then the number of muscles, the
/// names of those that differ from 0 and of those that are mostly the prior's choice, and a
/// sentence on how to read them: it is another where few points drive (MuscleCourse::few_points).
/// Empty where gains or mirroring leave no groups.
nlohmann::ordered_json activations_json(const simulate::MuscleCourse& muscles);

/// One line from a run's summary: how many activations differ from 0, and how many are mostly the
/// prior's choice. Empty where the summary does not have them.
std::string activations_line(const nlohmann::ordered_json& summary);

}  // namespace hyperex::run
