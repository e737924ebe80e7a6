// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Each option of a simulation with another value of it, section by section.
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/simulate/options.hpp"

namespace hyperex::simulate::test {

using Options = SimulationOptions;

/// An option, another value of it, and the parts of the options (OptionSource) that contain it.
struct OptionCase {
  std::string name;
  std::vector<std::string> sources;
  std::function<void(Options&)> change;
  std::optional<bool> has_effect = true;  ///< on where the face goes; empty: not checked
};

inline const OptionCase& case_of(const std::vector<OptionCase>& cases, const std::string& name) {
  return *std::ranges::find(cases, name, &OptionCase::name);
}

const std::vector<OptionCase>& model_cases();
const std::vector<OptionCase>& tissue_cases();
const std::vector<OptionCase>& support_cases();
const std::vector<OptionCase>& drive_cases();
const std::vector<OptionCase>& muscle_cases();
const std::vector<OptionCase>& region_cases();
const std::vector<OptionCase>& finite_solver_cases();
const std::vector<OptionCase>& solver_cases();
const std::vector<OptionCase>& contact_cases();
const std::vector<OptionCase>& surgery_cases();
const std::vector<OptionCase>& time_cases();

}  // namespace hyperex::simulate::test
