// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "hyperex/simulate/performance.hpp"

namespace hyperex::run {

/// The sample in which all muscles together are most active.
Eigen::Index most_active_sample(const simulate::MuscleCourse& muscles);

/// activations.csv: a row a sample of the motion; time_s, jaw_opening_deg, then of each muscle its
/// activation (1 moves the skin by 10 mm where most) and its standard deviation. `muscles` has
/// names.
void write_activations_csv(const std::filesystem::path& file,
                           const simulate::MuscleCourse& muscles);

/// Where the summed activation is greatest: each group's activation and standard deviation by side,
/// and what may be read from it. `driven_points`: how many there were.
nlohmann::ordered_json activations_json(const simulate::MuscleCourse& muscles,
                                        std::size_t driven_points);

}  // namespace hyperex::run
