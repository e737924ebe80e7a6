// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The axes of a study's grid, and their combinations.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/study/study.hpp"

namespace hyperex::study {

/// One step on an axis: its part of a case.
struct Step {
  std::string label;  ///< its part of a case's name: "young_kpa=30", "subject A"
  std::vector<scene::Override> overrides;
  Cells cells;
};

struct Axis {
  std::string name;               ///< a key, or the name that the study gives it
  int line = 0;                   ///< in the study file; 0 for the rows of a CSV
  std::vector<Step> steps;        ///< one or more
  std::vector<std::string> keys;  ///< the keys that its steps set
};

/// The content of a study file, and its errors.
struct StudyText {
  std::filesystem::path file;
  nlohmann::json root;
  std::map<std::string, int> lines;
  std::vector<InputProblem> problems = {};

  int line_of(const std::string& name) const;
  void complain(const std::string& name, const nlohmann::json& value, const std::string& expected);
  /// KEY=VALUE with the place of `name` in the file; adds a problem where there is no such key.
  scene::Override override_of(const std::string& key, const nlohmann::json& value,
                              const std::string& name);
};

/// A value as written in a cell of a table or in a name: a string without its quotes.
std::string cell_of(const nlohmann::json& value);

/// The axes of `grid`, in the order of the file.
std::vector<Axis> read_axes(StudyText& text);

/// All combinations of one step of each axis; the last axis varies fastest. Without axes: one empty
/// step. There must be at most kMostCases combinations.
std::vector<Step> combined(const std::vector<Axis>& axes);

}  // namespace hyperex::study
