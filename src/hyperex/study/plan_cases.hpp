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

/// Called with how many cases are done.
using Done = std::function<void(std::size_t)>;

/// Reads the scene of every case, and of the files that it names enough for the hash. Throws
/// InputError for all cases together, each sentence once, where a key or a value is wrong, or a
/// file is missing.
std::vector<PlannedCase> plan_cases(const Study& study, const Done& done = {});

/// Reads what the scenes of these cases name, as `hyperex check` does; cases that differ in
/// nothing that this looks at are looked at once. Throws InputError as plan_cases() does.
void check_inputs(const Study& study, const std::vector<std::size_t>& cases, const Done& done = {});

}  // namespace hyperex::study
