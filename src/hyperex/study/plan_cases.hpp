// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "hyperex/study/case_files.hpp"
#include "hyperex/study/study.hpp"

namespace hyperex::study {

struct PlannedCase {
  std::string hash;  ///< hash_of() its scene
  CaseFiles files;
};

/// Called with the number of cases done so far.
using Done = std::function<void(std::size_t)>;

/// Reads the scene of every case, and hashes the files that it names. Throws one InputError for all
/// cases together, each sentence once, where a key or a value is wrong, or a file is missing.
std::vector<PlannedCase> plan_cases(const Study& study, const Done& done = {});

/// Checks the inputs that the scenes of these cases name, as `hyperex check` does. Cases that do
/// not differ in what is checked are checked once. Throws InputError as plan_cases() does.
void check_inputs(const Study& study, const std::vector<std::size_t>& cases, const Done& done = {});

}  // namespace hyperex::study
