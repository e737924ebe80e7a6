// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The axes of a study's grid, and their combinations.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/study/study.hpp"

namespace hyperex::study {

/// One step on an axis: a part of a case.
struct Step {
  std::string label;  ///< in a case's name: "young_kpa=30", "subject A"
  std::vector<scene::Override> overrides;
  Cells cells;
};

struct Axis {
  std::string name;               ///< a key, or what the study calls it
  int line = 0;                   ///< in the study file
  std::vector<Step> steps;        ///< one or more
  std::vector<std::string> keys;  ///< that it sets
};

/// What a study file says, and what is wrong with it.
struct StudyText {
  std::filesystem::path file;
  nlohmann::json root;
  std::map<std::string, int> lines;
  std::vector<InputProblem> problems = {};

  int line_of(const std::string& name) const;
  void complain(const std::string& name, const nlohmann::json& value, const std::string& expected);
  /// KEY=VALUE with the place of `name`; a problem where there is no such key.
  scene::Override override_of(const std::string& key, const nlohmann::json& value,
                              const std::string& name);
};

/// A value as a cell of a table and as a part of a name: a text without its quotes.
std::string cell_of(const nlohmann::json& value);

/// The axes of `grid`, in the order of the file.
std::vector<Axis> read_axes(StudyText& text);

/// Every combination with a step of each axis, the last axis varying fastest. No axis: one step of
/// nothing. The product must be at most kMostCases.
std::vector<Step> combined(const std::vector<Axis>& axes);

}  // namespace hyperex::study
