// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/simulate/performance.hpp"

namespace hyperex::run {

/// Writes gaze.csv with one row per frame: time_s, then expression::kGazeNames in degrees.
/// `performance` must have a gaze.
void write_gaze_csv(const std::filesystem::path& file, const simulate::Performance& performance);

}  // namespace hyperex::run
