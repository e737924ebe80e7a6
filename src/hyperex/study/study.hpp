// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A study: one scene, run with many different overrides (docs/studies.md).
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/scene/override.hpp"

namespace hyperex::study {

/// What a case changes, in columns of the study's table: {"tissue.young_kpa", "30"}.
using Cells = std::vector<std::pair<std::string, std::string>>;

struct Case {
  std::string name;                        ///< no other case has it
  std::vector<scene::Override> overrides;  ///< those of the whole study first
  Cells cells;
  scene::Origin origin;  ///< of a row of a CSV; else the study file
};

struct Study {
  std::filesystem::path file, scene;
  std::filesystem::path out;  ///< the folder of all cases
  std::vector<Case> cases;    ///< one or more, at most kMostCases
};

constexpr std::size_t kMostCases = 10000;

/// Reads a study file and lays out its cases: rows of its CSV, combined with each other those of
/// its axes, the last one varying fastest. Values are not looked at: read_scene_with() does that.
/// Relative paths are taken from the folder of the study file. Throws InputError with all problems
/// at once, a line each, naming file, key, value and what was expected.
Study read_study(const std::filesystem::path& file);

}  // namespace hyperex::study
