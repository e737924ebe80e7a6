// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What runs a study on a cluster: the schedulers that are there, called by a short script. Each
// case is `hyperex sweep STUDY --case N`, and the table `hyperex sweep STUDY --collect`.
#include <string>
#include <vector>

#include "hyperex/study/plan_cases.hpp"

namespace hyperex::study {

/// How the program and the study are called from anywhere: absolute paths.
struct Called {
  std::filesystem::path program, study, out;
};

/// A shell script that submits the cases to Slurm as job arrays of at most 1,000 tasks, and a job
/// behind them that makes the table, also where cases fail.
std::string slurm_script(const Called& called, std::size_t cases);

/// A Snakefile: a job a case, whose output is the case's folder, and one for the table.
std::string snakefile(const Called& called, const std::vector<PlannedCase>& planned);

}  // namespace hyperex::study
