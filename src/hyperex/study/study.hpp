// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A study: one scene, run with many different overrides (docs/studies.md).
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/scene/override.hpp"

namespace hyperex::study {

/// The changes of a case, as columns of the study's table: {"tissue.young_kpa", "30"}.
using Cells = std::vector<std::pair<std::string, std::string>>;

struct Case {
  std::string name;                        ///< unique in the study
  std::vector<scene::Override> overrides;  ///< the overrides of the whole study come first
  Cells cells;
  scene::Origin origin;  ///< the row of a CSV, or else the study file
};

struct Study {
  std::filesystem::path file, scene;
  std::filesystem::path out;  ///< the folder that contains all cases
  std::vector<Case> cases;    ///< one or more, at most kMostCases
};

constexpr std::size_t kMostCases = 10000;

/// Reads a study file and makes its cases: all combinations of the rows of its CSV and the steps of
/// its axes; the last axis varies fastest. Values are not checked here but in read_scene_with().
/// Cases of linear strain beside one of finite strain get contact.lips=false (settle_contact()).
/// Relative paths are relative to the folder of the study file. Throws one InputError with all
/// problems, one line each, which names file, key, value and what was expected.
Study read_study(const std::filesystem::path& file);

}  // namespace hyperex::study
